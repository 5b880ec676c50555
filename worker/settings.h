// The configuration of a bake: one declaration of every key, from which reading, writing and help are made.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace veduta {

/// Every setting that changes a result. Lengths in metres.
struct Settings {
  struct {
    /// files, folders, archives; relative ones are relative to the configuration file
    std::vector<std::string> model;
    double terrain_tile_m = 64.0;  ///< terrain is cut into square objects of this edge
    // What the files do not say, or say wrongly: see ImportOptions in scene/import.h.
    std::string up = "auto";  ///< "auto", "y", "z"
    double unit_m = 0;        ///< metres in a unit of the files; 0: as they say
    std::string crs;
    std::string height_field, floors_field;  ///< of footprints
    double floor_height_m = 3.0;
  } scene;
  struct {
    std::string mode = "walk";   ///< "walk": cells at eye height above ground; "fly": over a range of heights
    double seed_size_m = 0.125;  ///< a gap of two seeds stays open, a narrower one may close; a voxel is four
    double eye_height_m = 1.7;   ///< walk: above ground, +- 0.25 m
    double fly_lowest_m = 0, fly_highest_m = 60;  ///< fly: above ground
  } navigation;
  struct {
    double size_m = 10.0;   ///< horizontal edge of a view-cell
    double height_m = 1.0;  ///< vertical edge of a view-cell; cells stack where the ground varies more
    int largest = 4;        ///< fly: in open space, cells are up to this many times as large; a power of two
    /// Corners of a polygon in the scene's CRS: cells are made where their centre lies in it (even-odd);
    /// none: everywhere.
    std::vector<std::array<double, 2>> region;
  } cells;
  struct {
    int max = 8;  ///< most slices per axis of an object
  } slices;
  struct {
    std::string method = "planes";
  } shrink;
  struct {
    std::string method = "panorama";
    int resolution = 1024;          ///< pixels along the edge of a cube face, for the smallest parts
    int subdivide = 8;              ///< the smallest parts: subdivide x subdivide of a cell; a power of two
    double max_overestimate = 1.5;  ///< parts are divided until a row has no more objects than this many
                                    ///< times those that rays have met for certain
  } occlusion;
  struct {
    double eye_margin_m = 0.0325;  ///< half the interocular distance: one look-up serves both eyes
  } stereo;
};

/// Reads a TOML file. Model paths come out absolute.
/// \throw Error(usage) with file and line for an unknown key (naming the nearest known one), a wrong type or
/// a value out of
///   range; Error(input_output) when the file cannot be read.
Settings load_settings(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages, relative model paths are relative to `base`.
Settings parse_settings(const std::string& text, const std::string& name, const std::filesystem::path& base);

/// The resolved configuration, every key with its value, in a fixed order: what `run.toml` and the file hold.
std::string to_toml(const Settings& settings);

/// Every key path ("cells.size") with its value as TOML, in the same order: what the fingerprint of a job is
/// made of.
std::vector<std::pair<std::string, std::string>> list_settings(const Settings& settings);

/// Every key with type, range, default and help, for `veduta bake --help-config` and docs/configuration.md.
std::string describe_settings();

}  // namespace veduta

// Names, descriptions and limits of what a file holds (DESIGN §9): the one list that writer, reader and
// checks share.
#pragma once

#include <array>
#include <map>
#include <string>

#include "pvs/hdf5_handle.h"
#include "pvs/hdf5_pack.h"
#include "pvs/pvs_file.h"

namespace veduta {

inline constexpr const char* pvs_format = "veduta-pvs";
inline constexpr const char* city_format = "veduta-city";  ///< a prepared city: no rows
/// 1 had one octree of free space, 2 no over-estimates, 3 objects and three bytes where 4 has steps and
/// forms.
inline constexpr uint32_t pvs_version = 4;
inline constexpr uint32_t city_version = 3;  ///< 1 and 2 as above; it has no rows, so that 3 stays readable
inline constexpr size_t chunk_bytes = 256 * 1024;
inline constexpr uint32_t octree_depth_limit = 20;
inline constexpr int root_number_limit = 1 << 30;
inline constexpr uint64_t attribute_bytes_limit = 16u << 20;

/// One dataset. `columns` is the extent after the first: 1 for a vector; 0 stands for what the data says.
struct Column {
  const char* path;
  hdf5::Element element;
  uint64_t columns;
  const char* description;
  hdf5::Deflate deflate{};
};

namespace column {
using hdf5::Element;
/// For rows, which are most of a large bake: 7 to 9 % less than by the usual, in twice the time. Level 9
/// takes up to four times as long again, most of all where rows repeat much, for at most 2 %.
inline constexpr hdf5::Deflate deflate_rows{7, true};
inline constexpr Column vertices{"/scene/vertices", Element::f32, 3,
                                 "[V,3] x, y, z of each vertex, m, relative to the root's origin"};
inline constexpr Column triangles{"/scene/triangles", Element::u32, 3, "[T,3] vertices of each triangle"};
inline constexpr Column material{
    "/scene/material", Element::u8, 1,
    "[T] 0 unknown, 1 wall, 2 roof, 3 ground, 4 terrain, 5 road, 6 water, 7 vegetation, 8 window, 9 door"};
inline constexpr Column triangle_slice{
    "/scene/triangle_slice", Element::u8, 6,
    "[T,6] first and last slice that the triangle touches along x, y, z; 1-based"};
inline constexpr Column object_name{"/scene/objects/name", Element::text, 1, "[N] name of each object"};
inline constexpr Column object_kind{
    "/scene/objects/kind", Element::u8, 1,
    "[N] 0 building, 1 terrain, 2 road, 3 water, 4 vegetation, 5 bridge, 6 other"};
inline constexpr Column object_bounds{
    "/scene/objects/bounds", Element::f32, 6,
    "[N,6] lower x, y, z and upper x, y, z, m; inf, -inf for an object without triangles"};
inline constexpr Column object_begin{
    "/scene/objects/triangle_begin", Element::u64, 1,
    "[N+1] triangles of object i are triangle_begin[i] to triangle_begin[i+1]-1"};
inline constexpr Column object_slices{"/scene/objects/slices", Element::u8, 3,
                                      "[N,3] slices along x, y, z, 1 to 127"};
inline constexpr Column part_name{"/scene/parts/name", Element::text, 1,
                                  "[P] name of each named part of an object"};
inline constexpr Column part_object{"/scene/parts/object", Element::u32, 1,
                                    "[P] the object that the part belongs to"};
inline constexpr Column part_begin{"/scene/parts/triangle_begin", Element::u64, 1, "[P] first triangle"};
inline constexpr Column part_end{"/scene/parts/triangle_end", Element::u64, 1,
                                 "[P] one past the last triangle"};
inline constexpr Column cell_bounds{
    "/cells/bounds", Element::f32, 6,
    "[C,6] lower x, y, z and upper x, y, z of each view-cell, a closed box, m"};
inline constexpr Column free_roots{"/navigation/free/roots", Element::i32, 3,
                                   "[R,3] number of each root: its lower corner is lower + number * "
                                   "leaf_size_m * 2^depth; root r is node r. "
                                   "Navigable: free voxels in view-cells"};
inline constexpr Column free_states{"/navigation/free/states", Element::u16, 1,
                                    "[M] bits 2k, 2k+1: of child k = x+2y+4z is 0 nothing, 1 all, 2 a part "
                                    "in the set"};
inline constexpr Column free_first_child{"/navigation/free/first_child", Element::u32, 1,
                                         "[M] the first child of which a part is; the others follow it"};
inline constexpr Column surface_roots{"/navigation/surfaces/roots", Element::i32, 3,
                                      "[R,3] as those of /navigation/free; voxels that a triangle passes"};
inline constexpr Column surface_states{"/navigation/surfaces/states", Element::u16, 1,
                                       "[M] as those of /navigation/free"};
inline constexpr Column surface_first_child{"/navigation/surfaces/first_child", Element::u32, 1,
                                            "[M] as those of /navigation/free"};
inline constexpr Column ground_height{
    "/navigation/ground/height", Element::f32, 0,
    "[ny,nx] highest ground in each square of edge step_m, m; NaN where there is none"};
inline constexpr Column cell_row{"/cells/row", Element::u32, 1,
                                 "[C] row of /pvs of each cell; cells share equal rows"};
inline constexpr Column cell_bake_us{"/cells/bake_us", Element::u32, 1,
                                     "[C] time that the bake of the cell took, us"};
inline constexpr Column cell_status{"/cells/status", Element::u8, 1, "[C] 0 baked, 1 coarse, 2 all visible"};
inline constexpr Column cell_overestimate{
    "/cells/overestimate", Element::f32, 1,
    "[C] objects of the row over objects that rays from the cell met, at least 1: an upper bound of the "
    "row's excess over the exact one; 0 where nobody looked"};
inline constexpr Column cell_worker{"/cells/worker", Element::u32, 1,
                                    "[C] who baked each cell: number of a name in worker_name; 4294967295 "
                                    "for a cell that nobody baked. May be missing"};
inline constexpr Column worker_name{"/cells/worker_name", Element::text, 1,
                                    "[W] name of each that baked cells. There with worker alone"};
inline constexpr Column pvs_begin{"/pvs/begin", Element::u64, 1,
                                  "[R+1] entries of row r are begin[r] to begin[r+1]-1"};
inline constexpr Column pvs_object_step{
    "/pvs/object_step", Element::u32, 1,
    "[K] visible objects, ascending in a row: the first of a row, then the difference to the one before it",
    deflate_rows};
inline constexpr Column pvs_form{
    "/pvs/form", Element::u16, 1,
    "[K] which form of the object is visible: row form_begin[object] + form of form_index", deflate_rows};
inline constexpr Column pvs_form_begin{"/pvs/form_begin", Element::u64, 1,
                                       "[N+1] forms of object o are form_begin[o] to form_begin[o+1]-1"};
inline constexpr Column pvs_form_index{
    "/pvs/form_index", Element::i8, 3,
    "[F,3] x, y, z of each form. A triangle is visible when z >= 1 and its last z-slice >= z, or x > 0 and "
    "its first x-slice <= x, or x < 0 and its last x-slice >= -x+1, or the same for y",
    deflate_rows};

inline constexpr Column verified_cell{"/verification/cells/cell", Element::u32, 1,
                                      "[v] view-cells that were checked, ascending"};
inline constexpr Column verified_rays{"/verification/cells/rays", Element::u64, 1,
                                      "[v] rays shot; 0 where no viewer can be in the cell"};
inline constexpr Column verified_objects{"/verification/cells/objects", Element::u64, 2,
                                         "[v,2] objects that the row lists, objects that rays met"};
inline constexpr Column verified_triangles{"/verification/cells/triangles", Element::u64, 2,
                                           "[v,2] triangles that the row draws, triangles that rays met"};
inline constexpr Column verified_false{
    "/verification/cells/false_invisible", Element::u64, 3,
    "[v,3] objects and triangles that rays met and the row does not draw; objects that were seen through "
    "narrow gaps alone, which are none of these"};
inline constexpr Column verified_solid_angle{
    "/verification/cells/solid_angle", Element::f32, 1,
    "[v] share of directions in which the first thing seen is false invisible"};
inline constexpr Column witness_cell{"/verification/examples/cell", Element::u32, 1,
                                     "[w] cell of rays that met what the row does not draw"};
inline constexpr Column witness_object{"/verification/examples/object", Element::u32, 1, "[w] object met"};
inline constexpr Column witness_triangle{"/verification/examples/triangle", Element::u64, 1,
                                         "[w] triangle met"};
inline constexpr Column witness_ray{
    "/verification/examples/ray", Element::f32, 9,
    "[w,9] x, y, z of the eye, m, of the direction, of length 1, and of the point met, m"};
inline constexpr Column witness_gap{"/verification/examples/gap", Element::f32, 2,
                                    "[w,2] width of the narrow gap that it was seen through and its distance "
                                    "from the eye, m; 0, 0: false invisible"};

inline constexpr const Column* all[] = {&vertices,          &triangles,
                                        &material,          &triangle_slice,
                                        &object_name,       &object_kind,
                                        &object_bounds,     &object_begin,
                                        &object_slices,     &part_name,
                                        &part_object,       &part_begin,
                                        &part_end,          &cell_bounds,
                                        &free_roots,        &free_states,
                                        &free_first_child,  &surface_roots,
                                        &surface_states,    &surface_first_child,
                                        &ground_height,     &cell_row,
                                        &cell_bake_us,      &cell_status,
                                        &cell_overestimate, &cell_worker,
                                        &worker_name,       &pvs_begin,
                                        &pvs_object_step,   &pvs_form,
                                        &pvs_form_begin,    &pvs_form_index,
                                        &verified_cell,     &verified_rays,
                                        &verified_objects,  &verified_triangles,
                                        &verified_false,    &verified_solid_angle,
                                        &witness_cell,      &witness_object,
                                        &witness_triangle,  &witness_ray,
                                        &witness_gap};

/// A forest of octrees in the file: its group, which has its lattice as attributes, and its datasets.
struct ForestColumns {
  const char* group;
  const Column& roots;
  const Column& states;
  const Column& first_child;
};
inline constexpr ForestColumns free_forest{"/navigation/free", free_roots, free_states, free_first_child};
inline constexpr ForestColumns surface_forest{"/navigation/surfaces", surface_roots, surface_states,
                                              surface_first_child};
}  // namespace column

/// By path: the digest of each dataset, 32 hex digits.
using ColumnDigests = std::map<std::string, std::string>;

/// Attributes of the root, as text or number; everything that `header_digest` covers.
struct RootAttributes {
  std::string format;
  uint32_t version = 0;
  std::string unit = "m", up = "z", crs;
  std::array<double, 3> origin{};
  PvsHeader header;
  std::string content_digest;
};

/// XXH3-128 over the logical content: dataset digests in the order of their paths without /cells/bake_us,
/// /cells/worker, /cells/worker_name and /verification, and the attributes that give numbers a meaning.
/// Over-estimates belong to it: a reader relies on them, and on one kind of machine they repeat as the rows
/// do. Not over config, renderer and fingerprint, which say how it was made.
std::string content_digest(const City& city, bool conservative, const ColumnDigests& digests);

/// XXH3-128 over the root's attributes: without it, a flipped bit in a text could go unseen.
std::string header_digest(const RootAttributes& root);

}  // namespace veduta

#include <fmt/format.h>

#include <algorithm>

#include "pvs/pvs_summary.h"

namespace veduta {

namespace {

std::string overestimate_line(const PvsSummary& s) {
  if (s.certified == 0) return "  certified  no over-estimate: nobody looked\n";
  std::string out =
      fmt::format("  certified  over-estimate in objects {:.2f}x median, {:.2f}x worst, of {} cells",
                  s.median_overestimate, s.worst_overestimate, s.certified);
  if (s.asked_overestimate)
    out += fmt::format("; {:.1f} % of all within the {:g}x asked for", 100 * s.within_asked,
                       *s.asked_overestimate);
  return out + "\n";
}

std::string workers_line(const PvsFile& file, const PvsSummary& s) {
  if (file.workers.empty()) return "  workers    not known\n";
  const auto most = std::max_element(s.worker_cells.begin(), s.worker_cells.end());
  return fmt::format("  workers    {}; {} baked most, {} cells\n", s.worker_cells.size(),
                     file.workers[static_cast<size_t>(most - s.worker_cells.begin())], *most);
}

/// What the rows take, and what they would take otherwise.
std::string size_lines(const PvsSummary& s) {
  std::string parts;
  for (const auto& [path, bytes] : s.pvs_bytes_of)
    parts += fmt::format("{}{} {:.1f}", parts.empty() ? "" : ", ", path.substr(1),
                         s.cells == 0 ? 0 : static_cast<double>(bytes) / static_cast<double>(s.cells));
  return fmt::format("  size       {} bytes; the PVS {} bytes, {:.1f} bytes a cell\n", s.file_bytes,
                     s.pvs_bytes, s.pvs_bytes_per_cell()) +
         fmt::format("             {}\n", parts) +
         fmt::format(
             "             instead of {:.1f} with three bytes for every object, {:.1f} with runs of zeros "
             "coded\n",
             s.three_bytes, s.three_bytes_runs) +
         fmt::format(
             "             or {:.1f} with a bit for every object, {:.1f} with runs of zeros coded: without "
             "slices\n",
             s.bits, s.bits_runs);
}

}  // namespace

std::string describe(const PvsFile& file, const std::filesystem::path& path) {
  const PvsSummary s = summarize(file, path);
  const auto& origin = file.city.scene.origin;
  std::string out =
      fmt::format("{}: {}{}\n", path.string(), file.header.complete ? "complete" : "not complete",
                  file.header.conservative ? ", conservative" : ", not conservative");
  out +=
      fmt::format("  scene      {} objects, {} triangles, {} vertices\n", s.objects, s.triangles, s.vertices);
  out += fmt::format("  place      {}, origin {:.3f} {:.3f} {:.3f} m\n",
                     file.city.scene.crs.empty() ? "CRS unknown" : file.city.scene.crs, origin[0], origin[1],
                     origin[2]);
  out += fmt::format("  cells      {}: {} baked, {} coarse, {} all visible\n", s.cells, s.status[0],
                     s.status[1], s.status[2]);
  for (const auto& [edge, count] : s.sizes)
    out += fmt::format("  cell size  {:g} x {:g} x {:g} m: {}\n", edge[0], edge[1], edge[2], count);
  out += workers_line(file, s);
  out += fmt::format("  rows       {} unique, {} entries\n", s.rows, s.entries);
  out += fmt::format("  visible    {:.1f} objects a cell in the mean, {} median, {} most, of {}\n",
                     s.mean_visible, s.median_visible, s.max_visible, s.objects);
  out += overestimate_line(s);
  out += file.verification ? describe_verification(*file.verification, file) : "  verified   no\n";
  out += size_lines(s);
  out += fmt::format("  renderer   {}\n", file.header.renderer.empty() ? "not known" : file.header.renderer);
  out += fmt::format("  digest     {}\n", file.content_digest);
  return out;
}

}  // namespace veduta

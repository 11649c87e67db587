#include "apps/cell_files.hpp"

#include <cmath>
#include <utility>

#include "apps/inputs.hpp"
#include "apps/io/write/npy.hpp"

namespace powercell::app {

std::vector<std::string> cell_file_names(const std::string& table, const std::string& walls, int shift_axes) {
  std::vector<std::string> files;
  if (!table.empty()) files.push_back(table);
  if (!walls.empty())
    for (std::string& file : io::walls_files(walls, shift_axes)) files.push_back(std::move(file));
  return files;
}

CellFiles::CellFiles(std::string table, std::string walls, io::SeedStream& seeds, const Domain& domain,
                     RunReport& report)
    : table_(std::move(table)),
      walls_(std::move(walls)),
      seeds_(seeds),
      dimension_(domain.dimension()),
      shift_axes_(shift_axes(domain)),
      report_(report) {}

void CellFiles::take(const CellRows& rows) {
  if (rows.first == 0) begin(rows.all_walls);
  const std::size_t count = rows.measures.mass.size();
  if (!table_.empty() && !io::is_npy(table_)) {  // which repeats them
    positions_.resize(count * static_cast<std::size_t>(dimension_));
    weights_.resize(count);
    seeds_.read(rows.first, positions_, weights_);
  }
  for (const std::unique_ptr<io::CellWriter>& writer : writers_)
    writer->add({rows.first,
                 {dimension_, positions_, weights_},
                 rows.measures,
                 rows.offset,
                 rows.neighbor,
                 rows.wall,
                 rows.shift});
  report_.measure += rows.measures.total();
  if (rows.first + count == seeds_.count()) end(rows.measures.domain_measure);
}

void CellFiles::take_none(double domain_measure) {
  begin(0);
  end(domain_measure);
}

void CellFiles::begin(std::uint64_t walls) {
  if (!table_.empty()) writers_.push_back(io::table_writer(table_, dimension_, seeds_.count()));
  if (!walls_.empty()) writers_.push_back(io::walls_writer(walls_, seeds_.count(), walls, shift_axes_));
}

void CellFiles::end(double domain_measure) {
  seeds_.require_unchanged();
  report_.domain_measure = domain_measure;
  if (domain_measure > 0)
    report_.relative_error = std::abs(report_.measure - domain_measure) / domain_measure;
  require_partition(report_);
  for (const std::unique_ptr<io::CellWriter>& writer : writers_) writer->commit();
}

}  // namespace powercell::app

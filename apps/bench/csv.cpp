#include "apps/bench/csv.hpp"

#include "apps/io/tables/seed_rows.hpp"

namespace powercell::app {
namespace {

struct Figure {
  const char *name, *unit;
  double value, scatter;
  std::string domain = {}, precision = {};
  std::size_t size = 0, runs = 0;  // 0: none, not known
};

class Table {
 public:
  explicit Table(const std::string& path) : rows_(path, ',') {
    for (const char* column :
         {"device", "name", "figure", "domain", "precision", "size", "value", "unit", "scatter", "runs"})
      rows_.text(column);
    rows_.end_row();
  }

  void add(const std::string& selector, const std::string& name, const Figure& figure) {
    for (const std::string& text :
         {selector, name, std::string(figure.name), figure.domain, figure.precision})
      rows_.text(text);
    count(figure.size);
    rows_.number(figure.value);
    rows_.text(figure.unit);
    rows_.number(figure.scatter);
    count(figure.runs);
    rows_.end_row();
  }

  void commit() { rows_.commit(); }

 private:
  void count(std::size_t value) { value ? rows_.count(value) : rows_.empty(); }

  io::FieldWriter rows_;
};

void add_device(Table& table, const BenchDevice& device) {
  const auto add = [&](const Figure& figure) { table.add(device.info.selector(), device.info.name, figure); };
  const DeviceLatencies& calls = device.latencies;
  if (calls.launch > 0) {
    add({"launch", "s", calls.launch, calls.launch_scatter});
    add({"transfer", "s", calls.transfer, calls.transfer_scatter});
  }
  for (const BenchRates& measured : device.rates) {
    const DeviceRates& rates = measured.rates;
    add({"copied", "bytes/s", rates.copied_bytes, rates.copied_scatter, {}, measured.precision});
    add({"operations", "operations/s", rates.operations, rates.operations_scatter, {}, measured.precision});
  }
  for (const BenchTransfers& measured : device.transfers) {
    const DeviceTransfers& rates = measured.rates;
    add({"to_device", "bytes/s", rates.to_device, rates.to_device_scatter, {}, {}, measured.bytes});
    add({"to_host", "bytes/s", rates.to_host, rates.to_host_scatter, {}, {}, measured.bytes});
  }
}

void add_row(Table& table, const BenchRow& row) {
  table.add(row.selector, row.device,
            {"measures", "cells/s", row.rate(), row.measures.scatter(), row.domain, row.precision, row.n,
             row.measures.seconds.size()});
  table.add(row.selector, row.device,
            {"adjacency", "cells/s", row.adjacency_rate(), row.adjacency.scatter(), row.domain, row.precision,
             row.n, row.adjacency.seconds.size()});
}

}  // namespace

void write_csv(const std::string& path, const BenchRecord& record) {
  Table table(path);
  for (const BenchDevice& device : record.devices) add_device(table, device);
  for (const BenchRow& row : record.rows)
    if (row.failure.empty()) add_row(table, row);
  table.commit();
}

}  // namespace powercell::app

#include "lib/clip/row_reader.hpp"

#include <algorithm>

namespace powercell {

RowReader::RowReader(const std::shared_ptr<cl::Context>& context)
    : pack_(context, context->program("clip/pack.cl", {}), "pack_rows"),
      scan_(context, ExclusiveScan::Type::uint32),
      packed_(context) {}

void RowReader::begin(cl::Buffer<std::uint32_t>& counts, std::size_t capacity,
                      std::vector<std::uint32_t>& offset) {
  scan_.enqueue(counts.handle(), static_cast<std::uint32_t>(counts.size()));
  offset.resize(counts.size());
  counts.download(std::span(offset));
  offset_ = counts.handle();
  rows_ = counts.size() - 1;
  capacity_ = capacity;
  total_ = offset.back();
}

template <class T>
void RowReader::read_values(cl_mem rows, std::size_t width, std::vector<T>& to) {
  to.resize(total_ * width);
  if (to.empty()) return;
  const std::size_t bytes = to.size() * sizeof(T);
  if (bytes > packed_.bytes()) packed_.reserve(bytes + bytes / 4);  // the next launch has about as many
  pack_
      .args(static_cast<cl_uint>(rows_), static_cast<cl_uint>(capacity_),
            static_cast<cl_uint>(width * sizeof(T) / sizeof(cl_uint)), offset_, rows, packed_)
      .launch(rows_);
  packed_.read(to.data(), bytes);
}

void RowReader::read(const cl::Buffer<std::int32_t>& rows, std::size_t width, std::vector<std::int32_t>& to) {
  read_values(rows.handle(), width, to);
}

void RowReader::read(const cl::Buffer<std::uint32_t>& rows, std::size_t width,
                     std::vector<std::uint32_t>& to) {
  read_values(rows.handle(), width, to);
}

void RowReader::read_reals(const cl::RawBuffer& rows, bool float32, std::size_t width,
                           std::vector<double>& to) {
  if (!float32) return read_values(rows.handle(), width, to);
  read_values(rows.handle(), width, narrow_);
  to.resize(narrow_.size());
  std::copy(narrow_.begin(), narrow_.end(), to.begin());
}

}  // namespace powercell

#include "python/src/density.hpp"

#include <nanobind/stl/pair.h>

#include <powercell/error.hpp>

namespace powercell::python {
namespace {

/// A function of Python, which may be destroyed in any thread.
class Function {
 public:
  Function(nb::object function, CallSlot& slot, int dimension)
      : function_(new nb::object(std::move(function)),
                  [](nb::object* object) {
                    const nb::gil_scoped_acquire acquired;
                    delete object;
                  }),
        slot_(slot),
        dimension_(dimension) {}

  double operator()(const std::array<double, 3>& x) const {
    Call* const call = slot_.current();
    if (!call) throw Error(ErrorCode::internal, "a density was evaluated outside of a call");
    double value = 0;
    const bool ran = call->python([&] {
      nb::object point = dimension_ == 2 ? nb::object(nb::make_tuple(x[0], x[1]))
                                         : nb::object(nb::make_tuple(x[0], x[1], x[2]));
      value = nb::cast<double>(nb::float_((*function_)(*point)));
    });
    if (!ran) throw Error(ErrorCode::interrupted, "the density's function raised an exception");
    return value;
  }

 private:
  std::shared_ptr<nb::object> function_;
  CallSlot& slot_;
  int dimension_;
};

Density image_of(const nb::tuple& value) {
  const auto pixels = nb::cast<Matrix<double>>(value[0]);
  ImageView image{pixels.shape(1), pixels.shape(0), span_of(pixels)};
  for (std::size_t k = 0; k < 2; ++k) {
    image.low[k] = nb::cast<std::vector<double>>(value[1])[k];
    image.high[k] = nb::cast<std::vector<double>>(value[2])[k];
  }
  return Density::image(image);
}

}  // namespace

Density density_of(const nb::tuple& given, CallSlot& slot, int dimension) {
  const auto kind = nb::cast<std::string>(given[0]);
  if (kind == "constant") return Density::constant(nb::cast<double>(given[1]));
  if (kind == "formula") return Density::formula(nb::cast<std::string>(given[1]));
  if (kind == "function") return Density::function(Function(given[1], slot, dimension));
  if (kind == "image") return image_of(nb::cast<nb::tuple>(given[1]));
  return Density::nodal(span_of(nb::cast<Vector<double>>(given[1])));
}

}  // namespace powercell::python

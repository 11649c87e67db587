#include <powercell/error.hpp>
#include <powercell/log.hpp>
#include <powercell/version.hpp>

#include "python/src/call.hpp"

namespace powercell::python {
namespace {

/// Errors of the library become powercell.Error, with the code.
void translate(const std::exception_ptr& exception, void*) {
  try {
    std::rethrow_exception(exception);
  } catch (const Error& error) {
    const nb::object type = nb::module_::import_("powercell._errors").attr("Error");
    const nb::object value = type(error.what(), name(error.code()));
    PyErr_SetObject(type.ptr(), value.ptr());
  }
}

}  // namespace
}  // namespace powercell::python

NB_MODULE(_core, m) {
  using namespace powercell::python;
  nb::set_leak_warnings(false);  // objects may live on when the interpreter ends
  nb::register_exception_translator(translate);
  m.def("version", &powercell::version);
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&InFlight::end_all));
  bind_devices(m);
  bind_queues(m);
  bind_domains(m);
  bind_results(m);
  bind_densities(m);
  bind_point_sets(m);
  bind_checks(m);
  bind_log(m);
  bind_diagrams(m);
  bind_distributed(m);
  bind_out_of_core(m);
  bind_transport(m);
  bind_sampling(m);
  bind_remeshing(m);
  bind_treemaps(m);
  bind_files(m);
  bind_seeds_outside(m);
}

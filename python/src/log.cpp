#include <powercell/error.hpp>
#include <powercell/log.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

thread_local bool in_sink = false;

/// Passes a line on to a function of Python. What that raises goes to sys.unraisablehook: it must not affect
/// the computation.
void pass_on(const nb::object& sink, LogLevel level, std::string_view line) {
  if (InFlight::ending()) return;
  const nb::gil_scoped_acquire acquired;
  in_sink = true;
  try {
    sink(level == LogLevel::info ? "info" : "detail", nb::str(line.data(), line.size()));
  } catch (nb::python_error& error) {
    error.discard_as_unraisable("the sink of powercell's log");
  }
  in_sink = false;
}

/// Lines come from calls that have released the interpreter's lock, never from one that holds it: the sink
/// would wait for that.
void send_log(const nb::object& sink, const std::string& level) {
  const LogLevel most =
      chosen<LogLevel>("level", level, {{"info", LogLevel::info}, {"detail", LogLevel::detail}});
  if (in_sink) throw Error(ErrorCode::invalid_argument, "set_log is called by the sink of the log");
  LogSink passing;
  if (!sink.is_none())
    passing = [kept = shared(sink)](LogLevel of, std::string_view line) { pass_on(*kept, of, line); };
  without_lock([&] { set_log(std::move(passing), most); });
}

}  // namespace

void bind_log(nb::module_& m) {
  m.def("set_log", &send_log, "sink"_a.none(), "level"_a);
}

}  // namespace powercell::python

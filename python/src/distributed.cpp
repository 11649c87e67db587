#include <powercell/distributed.hpp>
#include <powercell/error.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"
#include "python/src/seeds.hpp"

namespace powercell::python {
namespace {

/// Ranks that reach each other by a function of Python: it takes a list of bytes, one for each rank, and
/// returns those that came from each.
class PyCommunicator : public Communicator {
 public:
  PyCommunicator(int rank, int size, nb::object exchange, Call& call)
      : rank_(rank), size_(size), exchange_(std::move(exchange)), call_(call) {}

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  std::vector<Message> exchange(std::vector<Message> messages) override {
    std::vector<Message> received;
    // Others wait for the message that this rank has failed.
    const bool ran = call_.python_in_any_case([&] {
      nb::list out;
      for (const Message& message : messages) out.append(nb::bytes(message.data(), message.size()));
      for (const nb::handle message : nb::iter(exchange_(out))) {
        const auto bytes = nb::cast<nb::bytes>(message);
        const auto* const data = static_cast<const std::byte*>(bytes.data());
        received.emplace_back(data, data + bytes.size());
      }
    });
    if (!ran) throw Error(ErrorCode::interrupted, "the communicator of this rank has failed");
    return received;
  }

 private:
  int rank_, size_;
  nb::object exchange_;
  Call& call_;
};

}  // namespace

void bind_distributed(nb::module_& m) {
  nb::class_<ExchangeReport>(m, "ExchangeReport", "What ranks sent to each other, of all together.")
      .def_ro("rounds", &ExchangeReport::rounds, "In which some cell was clipped.")
      .def_ro("fetched", &ExchangeReport::fetched, "Seeds sent to other ranks, once for each.")
      .def_ro("neighbors", &ExchangeReport::neighbors, "Of these, with a wall in the end.")
      .def_ro("clipped", &ExchangeReport::clipped, "Cells, counted each time.")
      .def_ro("vertices", &ExchangeReport::vertices, "That other ranks were asked about.")
      .def_ro("outlines", &ExchangeReport::outlines, "Bytes of the upper levels of trees.")
      .def_ro("requests", &ExchangeReport::requests, "Bytes of the questions.")
      .def_ro("replies", &ExchangeReport::replies, "Bytes of the answers.")
      .def_ro("ending", &ExchangeReport::ending, "Bytes of the messages about hidden seeds.")
      .def_ro("redistributed", &ExchangeReport::redistributed, "Bytes of seeds and results sent elsewhere.");
  nb::class_<DistributedCells>(m, "DistributedCells")
      .def_ro("measures", &DistributedCells::measures)
      .def_prop_ro("indptr",
                   [](nb::handle self) { return view(nb::cast<DistributedCells&>(self).offset, self); })
      .def_prop_ro("indices",
                   [](nb::handle self) { return view(nb::cast<DistributedCells&>(self).neighbor, self); })
      .def_prop_ro("data", [](nb::handle self) { return view(nb::cast<DistributedCells&>(self).wall, self); })
      .def_prop_ro("shift", [](nb::handle self) { return shifts(nb::cast<DistributedCells&>(self), self); })
      .def_ro("report", &DistributedCells::report);
  m.def(
      "compute_distributed",
      [](int rank, int size, nb::object exchange, const Device& device, const Domain& domain,
         const Vector<std::uint64_t>& ids, const Matrix<double>& positions, const Weights& weights,
         const nb::dict& options, bool redistribute, nb::object progress) {
        const SeedsView seeds = seeds_of(positions, weights);
        const std::span all_ids = span_of(ids);
        Call call(std::move(progress));
        DistributedOptions with{options_of(options), redistribute};
        with.diagram.progress = [&](double fraction) { return call.report(fraction); };
        PyCommunicator communicator(rank, size, std::move(exchange), call);
        return call.run(
            [&] { return compute_distributed(communicator, device, domain, all_ids, seeds, with); });
      },
      "rank"_a, "size"_a, "exchange"_a, "device"_a, "domain"_a, "ids"_a, "positions"_a, "weights"_a.none(),
      "options"_a, "redistribute"_a, "progress"_a.none());
}

}  // namespace powercell::python

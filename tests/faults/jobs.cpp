#include "tests/faults/jobs.hpp"

#include <cstring>
#include <numeric>
#include <optional>
#include <powercell/opencl.hpp>
#include <powercell/regions.hpp>

#include "lib/cl/context.hpp"
#include "lib/cl/self_test.hpp"

namespace powercell::test {
namespace {

std::vector<double> other_weights(const SeedArray& seeds) {
  std::vector<double> weights = seeds.weights;
  std::rotate(weights.begin(), weights.begin() + 1, weights.end());
  return weights;
}

class DiagramJob : public Job {
 public:
  DiagramJob(std::function<Device()> device, const Setup& setup, const NamedDomain& domain,
             const SeedArray& seeds)
      : make_device_(std::move(device)),
        options_(setup.options),
        domain_(domain.domain),
        seeds_(seeds),
        weights_(other_weights(seeds)) {}

  std::size_t steps() const override { return 10; }
  void step(std::size_t k) override {
    switch (k) {
      case 0:
        diagram_.emplace(make_device_(), domain_, options_);
        return;
      case 1:
        diagram_->set_seeds(seeds_.view());
        return;
      case 2:
        diagram_->measures();
        return;
      case 3:
        diagram_->adjacency();
        return;
      case 4:
        diagram_->cells();
        return;
      case 5:
        first_ = results_of(*diagram_);
        return;
      case 6:
        diagram_->set_weights(weights_);
        return;
      case 7:
        diagram_->cells();
        return;
      case 8:
        diagram_->adjacency();
        return;
      default:
        second_ = results_of(*diagram_);
    }
  }
  std::string differences(const Job& other) const override {
    const auto& that = dynamic_cast<const DiagramJob&>(other);
    return bit_differences(first_, that.first_) + bit_differences(second_, that.second_);
  }

 private:
  std::function<Device()> make_device_;
  Options options_;
  Domain domain_;
  SeedArray seeds_;
  std::vector<double> weights_;
  std::optional<Diagram> diagram_;
  Results first_, second_;
};

class OpenJob : public Job {
 public:
  explicit OpenJob(std::string selector) : selector_(std::move(selector)) {}
  std::size_t steps() const override { return 1; }
  void step(std::size_t) override { device_.emplace(Device::choose(selector_)); }
  std::string differences(const Job& other) const override {
    const DeviceInfo &a = device_->info(), &b = dynamic_cast<const OpenJob&>(other).device_->info();
    const bool same = a.name == b.name && a.selector() == b.selector() && a.fp64 == b.fp64 &&
                      a.memory_bytes == b.memory_bytes && a.largest_allocation == b.largest_allocation &&
                      a.max_work_group_size == b.max_work_group_size && a.compute_units == b.compute_units;
    return same ? "" : "another device, or other properties";
  }

 private:
  std::string selector_;
  std::optional<Device> device_;
};

/// A density at the vertices of a mesh of triangles or tetrahedra, from 0 to 2; nothing for another domain.
std::vector<double> density_values(const Domain& domain) {
  const bool mesh =
      domain.kind() == DomainKind::surface || domain.regions().shape == RegionShape::tetrahedron;
  std::vector<double> values(mesh ? domain.regions().vertices.size() / 3 : 0);
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = static_cast<double>(v % 5) / 2;
  return values;
}

/// A buffer of the caller; throws errors as the library does.
class Memory {
 public:
  Memory(const Device& device, std::size_t bytes) : device_(device), bytes_(bytes) {
    cl_int status = CL_SUCCESS;
    memory_ = clCreateBuffer(device.context()->context(), CL_MEM_READ_WRITE, bytes, nullptr, &status);
    cl::check(status, "making a buffer of the test");
  }
  ~Memory() { clReleaseMemObject(memory_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  cl_mem handle() const { return memory_; }
  void write(const void* from) {
    cl::check(clEnqueueWriteBuffer(device_.context()->queue(), memory_, CL_TRUE, 0, bytes_, from, 0, nullptr,
                                   nullptr),
              "writing a buffer of the test");
  }
  std::vector<std::byte> read() const {
    std::vector<std::byte> bytes(bytes_);
    cl::check(clEnqueueReadBuffer(device_.context()->queue(), memory_, CL_TRUE, 0, bytes_, bytes.data(), 0,
                                  nullptr, nullptr),
              "reading a buffer of the test");
    return bytes;
  }

 private:
  Device device_;
  std::size_t bytes_;
  cl_mem memory_ = nullptr;
};

class DeviceDiagramJob : public Job {
 public:
  DeviceDiagramJob(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds)
      : device_(setup.device),
        options_(setup.options),
        domain_(domain.domain),
        float32_(setup.options.precision == Precision::float32),
        real_(float32_ ? sizeof(float) : sizeof(double)),
        n_(seeds.size()),
        seeds_(seeds),
        densities_(density_values(domain_)),
        positions_(device_, seeds.positions.size() * real_),
        weights_(device_, n_ * real_),
        measures_(device_, n_ * (2 + static_cast<std::size_t>(seeds.dimension)) * real_),
        status_(device_, n_ * sizeof(cl_uint)),
        offset_(device_, (n_ + 1) * sizeof(cl_uint)),
        neighbor_(device_, room * sizeof(cl_uint)),
        wall_(device_, room * real_),
        shift_(device_, room * 3 * sizeof(cl_int)),
        uncertain_count_(device_, sizeof(cl_uint)),
        uncertain_(device_, n_ * sizeof(cl_uint)),
        part_offset_(device_, (n_ + 1) * sizeof(cl_uint)),
        facet_(device_, room * sizeof(cl_uint)),
        part_(device_, room * real_),
        density_(device_, std::max<std::size_t>(densities_.size(), 1) * real_) {}

  std::size_t steps() const override { return densities_.empty() ? 7 : 8; }
  void step(std::size_t k) override {
    switch (k) {
      case 0:
        diagram_.emplace(device_, domain_, options_);
        return;
      case 1:
        write(positions_, seeds_.positions);
        write(weights_, seeds_.weights);
        return;
      case 2:
        compute();
        return;
      case 3:
        results_ = {measures_.read(), status_.read()};
        return;
      case 4:  // other weights in the same diagram, walls and boundary walls
        write(weights_, other_weights(seeds_));
        compute_all();
        others_ = all_results();
        return;
      case 5:
        compute_all();  // again in a repeated step: repair may have failed while it wrote
        diagram_->repair(positions_.handle(), weights_.handle(), static_cast<std::uint32_t>(n_), wanted());
        repaired_ = all_results();
        return;
      case 6:  // the weights from before, in the same Diagram
        write(weights_, seeds_.weights);
        compute_all();
        diagram_->repair(positions_.handle(), weights_.handle(), static_cast<std::uint32_t>(n_), wanted());
        repaired_again_ = all_results();
        return;
      default:  // with a density, in the same Diagram
        write(density_, densities_);
        diagram_->set_density(density_.handle());
        compute_all();
        dense_ = all_results();
        diagram_->repair(positions_.handle(), weights_.handle(), static_cast<std::uint32_t>(n_), wanted());
        dense_repaired_ = all_results();
    }
  }
  std::string differences(const Job& other) const override {
    const auto& that = dynamic_cast<const DeviceDiagramJob&>(other);
    if (repaired_ != that.repaired_ || repaired_again_ != that.repaired_again_)
      return "repaired results differ";
    if (dense_ != that.dense_ || dense_repaired_ != that.dense_repaired_)
      return "results with a density differ";
    return results_ == that.results_ && others_ == that.others_
               ? ""
               : "measures, statuses, walls or boundary walls differ";
  }

 private:
  void write(Memory& memory, const std::vector<double>& values) {
    const std::vector<float> narrow(values.begin(), values.end());
    memory.write(float32_ ? static_cast<const void*>(narrow.data()) : values.data());
  }
  using Bytes = std::vector<std::vector<std::byte>>;

  DeviceResults wanted() const {
    return {measures_.handle(),
            status_.handle(),
            {offset_.handle(), neighbor_.handle(), wall_.handle(),
             domain_.is_periodic() ? shift_.handle() : nullptr},
            {uncertain_count_.handle(), uncertain_.handle()},
            {},
            {part_offset_.handle(), facet_.handle(), part_.handle()}};
  }
  Bytes all_results() const {
    return {measures_.read(), status_.read(),          offset_.read(),    neighbor_.read(),    wall_.read(),
            shift_.read(),    uncertain_count_.read(), uncertain_.read(), part_offset_.read(), facet_.read(),
            part_.read()};
  }
  void compute() { compute({measures_.handle(), status_.handle()}); }
  /// With walls and the list, into memory without what was there before.
  void compute_all() {
    write(wall_, std::vector<double>(room));
    neighbor_.write(std::vector<cl_uint>(room).data());
    shift_.write(std::vector<cl_int>(3 * room).data());
    uncertain_.write(std::vector<cl_uint>(n_).data());
    facet_.write(std::vector<cl_uint>(room).data());
    write(part_, std::vector<double>(room));
    compute(wanted());
  }
  void compute(const DeviceResults& results) {
    cl_event done = nullptr;
    diagram_->enqueue(positions_.handle(), weights_.handle(), static_cast<std::uint32_t>(n_), results, 0,
                      nullptr, &done);
    const cl_int status = clWaitForEvents(1, &done);
    clReleaseEvent(done);
    cl::check(status, "waiting for the diagram");
  }

  static constexpr std::size_t room = 2000;  // more walls than the cases have

  Device device_;
  Options options_;
  Domain domain_;
  bool float32_;
  std::size_t real_, n_;
  SeedArray seeds_;
  std::vector<double> densities_;
  Memory positions_, weights_, measures_, status_, offset_, neighbor_, wall_, shift_, uncertain_count_,
      uncertain_, part_offset_, facet_, part_, density_;
  std::optional<DeviceDiagram> diagram_;
  Bytes results_, others_, repaired_, repaired_again_, dense_, dense_repaired_;
};

}  // namespace

JobKind diagram_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds) {
  return {"Diagram, " + domain.name + ", " + setup.name, [=] {
            return std::make_unique<DiagramJob>([device = setup.device] { return device; }, setup, domain,
                                                seeds);
          }};
}

JobKind open_job(const Setup& setup) {
  const std::string selector = setup.device.info().selector();
  return {"Device", [=] { return std::make_unique<OpenJob>(selector); }};
}

JobKind device_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds) {
  const auto fresh = [known =
                          setup.device] {  // Device::choose would share the programs of those that are open
    const cl_device_id device = known.context()->device();
    cl_platform_id platform = nullptr;
    cl::check(cl::clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, nullptr),
              "asking for the platform");
    auto context = std::make_shared<cl::Context>(cl::SharedContext::make(platform, device), known.info());
    cl::self_test(context);
    return Device(std::move(context));
  };
  return {"Device and Diagram, " + domain.name + ", " + setup.name,
          [=] { return std::make_unique<DiagramJob>(fresh, setup, domain, seeds); }};
}

JobKind device_diagram_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds) {
  return {"DeviceDiagram, " + domain.name + ", " + setup.name,
          [=] { return std::make_unique<DeviceDiagramJob>(setup, domain, seeds); }};
}

std::vector<SeededDomain> small_cases() {
  std::vector<SeededDomain> cases = with_seeds({{"letter U", Domain::polygon(letter_u())},
                                                {"icosahedron", surface_of(icosphere(0))},
                                                {"ball", volume_of(ball_tetrahedra(0))},
                                                {"cube", unit_box(3)}},
                                               12);
  // Strips, and seeds so close together that the cells between them cannot be classified: the computation is
  // repeated with those clipped region by region.
  Parts strips;
  for (int k = 0; k < 7; ++k)
    strips.push_back({{{k / 7., 0}, {(k + 1) / 7., 0}, {(k + 1) / 7., 1}, {k / 7., 1}}, {}});
  SeedArray thin{2, {}, {}};
  for (int k = 0; k < 4; ++k) thin.push({0.5 + 1e-13 * k, 0.25 * k}, 0);
  for (int k = 0; k < 4; ++k) thin.push({0.5 + 1e-13 * k, 0.1}, 0);
  cases.push_back({{"strips", Domain::polygon(strips)}, thin});
  return cases;
}

SeededDomain many_faces(std::size_t faces) {
  SeedArray seeds = cospherical(faces, 2);
  seeds.push({0.5, 0.5}, 0.01);
  return {{std::to_string(faces) + " faces", unit_box(2)}, seeds};
}

SeededDomain ties() {
  SeedArray seeds = grid(4, 2);
  seeds.weights[5] = 0.01;
  return {{"ties", unit_box(2)}, seeds};
}

SeededDomain periodic_ties() {
  const double low[] = {0, 0}, high[] = {1, 1};
  return {{"periodic ties", Domain::periodic_box(low, high)}, ties().seeds};
}

}  // namespace powercell::test

// Particles of a simulation that has slabs of a cube, a slab for each rank of MPI. In each step every rank
// gets the cells of its particles among those of all ranks, moves its particles towards the centroids of
// their cells, and sends those that leave its slab to the rank that has them next. What is printed does not
// depend on the number of ranks.
//
//   mpirun -n 4 particles_mpi [PARTICLES [STEPS]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <powercell/distributed.hpp>
#include <powercell/mpi.hpp>
#include <random>
#include <vector>

namespace {

struct Particle {
  std::uint64_t id;
  double position[3];
  double radius;
};

/// The rank whose slab has the particle.
int owner(const Particle& particle, int ranks) {
  return std::clamp(static_cast<int>(particle.position[0] * ranks), 0, ranks - 1);
}

/// The same particles on any number of ranks.
std::vector<Particle> start(std::uint64_t count, int rank, int ranks) {
  std::vector<Particle> own;
  std::mt19937_64 engine(1);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const double spacing = std::cbrt(1.0 / static_cast<double>(count));
  for (std::uint64_t id = 0; id < count; ++id) {
    const Particle particle{id, {uniform(), uniform(), uniform()}, 0.5 * spacing * uniform()};
    if (owner(particle, ranks) == rank) own.push_back(particle);
  }
  return own;
}

/// Sends each particle to its owner.
void migrate(std::vector<Particle>& own, int ranks) {
  std::stable_sort(own.begin(), own.end(), [ranks](const Particle& a, const Particle& b) {
    return owner(a, ranks) < owner(b, ranks);
  });
  std::vector<int> sent(ranks), got(ranks), from(ranks), to(ranks);
  for (const Particle& particle : own) ++sent[owner(particle, ranks)];
  MPI_Alltoall(sent.data(), 1, MPI_INT, got.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (int r = 1; r < ranks; ++r) {
    from[r] = from[r - 1] + sent[r - 1];
    to[r] = to[r - 1] + got[r - 1];
  }
  MPI_Datatype type;
  MPI_Type_contiguous(sizeof(Particle), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  std::vector<Particle> arrived(to.back() + got.back());
  MPI_Alltoallv(own.data(), sent.data(), from.data(), type, arrived.data(), got.data(), to.data(), type,
                MPI_COMM_WORLD);
  MPI_Type_free(&type);
  own = std::move(arrived);
}

/// Moves particles halfway to the centroids of their cells.
void relax(std::vector<Particle>& own, const powercell::Measures& measures) {
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (measures.status[i] != powercell::SeedStatus::ok) continue;
    for (int k = 0; k < 3; ++k)
      own[i].position[k] += 0.5 * (measures.centroid[3 * i + k] - own[i].position[k]);
  }
}

struct Sums {
  double particles = 0, volume = 0, energy = 0, walls = 0;
};

Sums sums_of_all(const std::vector<Particle>& own, const powercell::DistributedCells& cells) {
  Sums sums;
  sums.particles = static_cast<double>(own.size());
  sums.volume = cells.measures.total();
  sums.walls = static_cast<double>(cells.neighbor.size());
  // What moves towards the centroids make smaller: the integral of the power distance.
  for (std::size_t i = 0; i < own.size(); ++i)
    sums.energy += cells.measures.second_moment[i] - own[i].radius * own[i].radius * cells.measures.mass[i];
  MPI_Allreduce(MPI_IN_PLACE, &sums, 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sums;
}

/// \return whether no particle and no volume was lost, and the energy fell in each step
bool simulate(std::uint64_t count, int steps) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  const powercell::Domain domain = powercell::Domain::box(low, high);
  const powercell::Device device = powercell::Device::choose();
  powercell::MpiCommunicator communicator(MPI_COMM_WORLD);
  const int rank = communicator.rank(), ranks = communicator.size();
  std::vector<Particle> own = start(count, rank, ranks);
  double energy = HUGE_VAL;
  bool good = true;
  for (int step = 0; step < steps; ++step) {
    std::vector<std::uint64_t> ids;
    std::vector<double> positions, weights;
    for (const Particle& particle : own) {
      ids.push_back(particle.id);
      positions.insert(positions.end(), particle.position, particle.position + 3);
      weights.push_back(particle.radius * particle.radius);
    }
    const powercell::DistributedCells cells =
        powercell::compute_distributed(communicator, device, domain, ids, {3, positions, weights});
    const Sums sums = sums_of_all(own, cells);
    if (rank == 0)
      std::printf("step %d: %.0f particles, volume %.12f, energy %.8f, %.3f walls a cell\n", step,
                  sums.particles, sums.volume, sums.energy, sums.walls / sums.particles);
    good = good && sums.particles == static_cast<double>(count) && std::abs(sums.volume - 1) < 1e-12 &&
           sums.energy < energy;
    energy = sums.energy;
    relax(own, cells.measures);
    migrate(own, ranks);
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int status = 1;
  try {
    status =
        simulate(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000, argc > 2 ? std::atoi(argv[2]) : 5)
            ? 0
            : 1;
  } catch (const powercell::Error& error) {  // the same on all ranks
    std::fprintf(stderr, "%s\n", error.what());
  }
  MPI_Finalize();
  return status;
}

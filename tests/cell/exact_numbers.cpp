#include <doctest/doctest.h>

#include <random>

#include "lib/cell/exact_rows.hpp"

using namespace powercell;

namespace {

/// Random integers of all lengths up to `bits`, the ends of the range among them.
class Numbers {
 public:
  Unbounded next(int bits) {
    const int length = static_cast<int>(random_() % static_cast<unsigned>(bits + 1));
    Unbounded x = 0;
    for (int k = 0; k < length; k += 32) x = (x << 32) + static_cast<std::uint32_t>(random_());
    x >>= static_cast<unsigned>((length + 31) / 32 * 32 - length);
    if (random_() % 8 == 0) x = (Unbounded(1) << static_cast<unsigned>(length)) - 1;
    return random_() % 2 == 0 ? x : Unbounded(-x);
  }

 private:
  std::mt19937_64 random_{7};
};

template <int n>
Wide<n> wide(const Unbounded& x) {
  Wide<n> y;
  const Unbounded size = x.sign() < 0 ? Unbounded(-x) : x;
  for (std::size_t k = 0; k < n; ++k)
    y.limb[k] =
        static_cast<std::uint64_t>(Unbounded((size >> static_cast<unsigned>(64 * k)) & ~std::uint64_t{0}));
  return x.sign() < 0 ? -y : y;
}

template <int n, int l>
void compare_rows() {
  Numbers numbers;
  const auto narrow = [](const UnboundedRow& row) {
    WideRow<n, l> to;
    for (std::size_t k = 0; k < 3; ++k) to.normal[k] = wide<n>(row.normal[k]);
    to.offset = wide<l>(row.offset);
    return to;
  };
  for (int round = 0; round < 4000; ++round) {
    std::array<UnboundedRow, 4> rows;
    for (UnboundedRow& row : rows) {
      for (Unbounded& x : row.normal) x = numbers.next(64 * n - 3);
      row.offset = numbers.next(64 * l - 2);
    }
    // Ties and planes through one line: the last row is a sum of the others.
    if (round % 4 == 1)
      for (std::size_t k = 0; k < 3; ++k)
        rows[3].normal[k] = (rows[0].normal[k] >> 1) - (rows[1].normal[k] >> 1);
    if (round % 4 == 2) rows[3] = rows[static_cast<std::size_t>(round) % 3];
    const auto a = narrow(rows[0]), b = narrow(rows[1]), c = narrow(rows[2]), p = narrow(rows[3]);
    const auto exact = factors_in_space(rows[0], rows[1], rows[2], rows[3]);
    const auto factor = factors_in_space(a, b, c, p);
    Unbounded sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(sign_of(factor[k]) == exact[k].sign());
      CHECK(factor[k].limb == wide<3 * n>(exact[k]).limb);
      sum += rows[k].offset * exact[k];
    }
    CHECK(determinant_sign(a, b, c, p, factor) == -sum.sign());
    const auto exact2 = factors_in_plane(rows[0], rows[1], rows[2]);
    CHECK(determinant_sign(a, b, c, factors_in_plane(a, b, c)) ==
          -Unbounded(rows[0].offset * exact2[0] + rows[1].offset * exact2[1] + rows[2].offset * exact2[2])
               .sign());
    if (exact[3].sign() == 0) continue;
    const auto place = meeting_in_space(rows[0], rows[1], rows[2], -30),
               same = meeting_in_space(a, b, c, -30);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(same[k].high == place[k].high);
      CHECK(same[k].low == place[k].low);
    }
  }
}

}  // namespace

TEST_CASE("planes of short integers decide as those of any length do") {
  compare_rows<1, 2>();
  compare_rows<1, 3>();
  compare_rows<2, 4>();
  compare_rows<3, 6>();
}

TEST_CASE("the determinant of four bisectors is 0 where their seeds and the cell's are on one sphere") {
  const auto bisector = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return UnboundedRow{{x, y, z}, x * x + y * y + z * z};
  };
  const auto a = bisector(2, 0, 0), b = bisector(0, 2, 0), c = bisector(0, 0, 2);
  const auto side = [&](const UnboundedRow& p) {
    return determinant_sign(a, b, c, p, factors_in_space(a, b, c, p));
  };
  CHECK(side(bisector(2, 2, 2)) == 0);
  CHECK(side(bisector(1, 1, 1)) > 0);  // nearer: the vertex at (1, 1, 1) is outside
  CHECK(side(bisector(3, 3, 3)) < 0);
}

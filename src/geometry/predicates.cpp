#include "geometry/predicates.h"

#include <cassert>
#include <cmath>

namespace weft {

namespace {

/// (7 + 56 eps) eps with eps = 2^-53: Shewchuk's bound of the rounding of the determinant,
/// relative to the sum of the magnitudes of its terms.
constexpr double k_filter = 7.7715611723761027e-16;

/// A number as a sum of doubles that do not overlap, smallest first. Long enough for the
/// determinant below: 3 * (2 * (2 * 2 * 2) * 2 * 2) = 192 terms.
class Expansion {
public:
    Expansion() = default;

    /// a - b, exactly.
    static Expansion difference(double a, double b) {
        Expansion e;
        const double x = a - b;
        const double virtual_b = a - x;
        const double virtual_a = x + virtual_b;
        e.push((a - virtual_a) + (virtual_b - b));
        e.push(x);
        return e;
    }

    Expansion& operator+=(const Expansion& other) {
        for (int i = 0; i < other.size_; ++i) {
            grow(other.term(i));
        }
        return *this;
    }

    Expansion operator-() const {
        Expansion e;
        for (int i = 0; i < size_; ++i) {
            e.push(-term(i));
        }
        return e;
    }

    Expansion operator*(const Expansion& other) const {
        Expansion product;
        for (int i = 0; i < size_; ++i) {
            for (int j = 0; j < other.size_; ++j) {
                const double high = term(i) * other.term(j);
                product.grow(std::fma(term(i), other.term(j), -high));
                product.grow(high);
            }
        }
        return product;
    }

    int sign() const {
        const double leading = size_ > 0 ? term(size_ - 1) : 0.0;
        return (leading > 0.0) - (leading < 0.0);
    }

private:
    double term(int i) const { return terms_[at(i)]; }

    void push(double x) {
        if (x != 0.0) {
            assert(size_ < 192);
            terms_[at(size_++)] = x;
        }
    }

    /// Adds one double (Shewchuk's Grow-Expansion, dropping zeros).
    void grow(double q) {
        const int old_size = size_;
        size_ = 0;
        for (int i = 0; i < old_size; ++i) {
            const double e = term(i);
            const double sum = q + e;
            const double virtual_e = sum - q;
            push((q - (sum - virtual_e)) + (e - virtual_e));
            q = sum;
        }
        push(q);
    }

    std::array<double, 192> terms_;
    int size_ = 0;
};

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<std::array<Expansion, 3>, 3> m;
    const std::array<const Vec3*, 3> rows{&a, &b, &c};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            m[i][k] = Expansion::difference((*rows[i])[axis], d[axis]);
        }
    }
    Expansion determinant;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& p = m[(i + 1) % 3];
        const auto& q = m[(i + 2) % 3];
        Expansion minor = p[0] * q[1];
        minor += -(p[1] * q[0]);
        determinant += minor * m[i][2];
    }
    return determinant.sign();
}

} // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 p = a - d;
    const Vec3 q = b - d;
    const Vec3 r = c - d;
    const double qr = q[0] * r[1];
    const double rq = q[1] * r[0];
    const double rp = r[0] * p[1];
    const double pr = r[1] * p[0];
    const double pq = p[0] * q[1];
    const double qp = p[1] * q[0];
    const double determinant = p[2] * (qr - rq) + q[2] * (rp - pr) + r[2] * (pq - qp);
    const double magnitude = std::abs(p[2]) * (std::abs(qr) + std::abs(rq)) +
                             std::abs(q[2]) * (std::abs(rp) + std::abs(pr)) +
                             std::abs(r[2]) * (std::abs(pq) + std::abs(qp));
    if (std::abs(determinant) > k_filter * magnitude) {
        return determinant > 0.0 ? 1 : -1;
    }
    return exact_orientation(a, b, c, d);
}

} // namespace weft

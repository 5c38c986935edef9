#include "motion/fourier.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"
#include "core/elementary.hpp"

namespace flowslide {
namespace {

using Complex = std::complex<double>;

/// exp(-2 pi i k/n) for k = 0 ... n - 1.
std::vector<Complex> roots_of_unity(std::size_t n) {
  std::vector<Complex> w(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = -2.0 * kPi * static_cast<double>(k) / static_cast<double>(n);
    w[k] = {cos(angle), sin(angle)};
  }
  return w;
}

Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

std::size_t smallest_factor(std::size_t n) {
  for (std::size_t p = 2; p * p <= n; ++p)
    if (n % p == 0) return p;
  return n;
}

/// Transform of in[0], in[stride], ... (n of them) into out[0 ... n - 1], from the transforms of
/// every p-th sample (Cooley and Tukey). `w` are the roots of unity of the whole length.
void fourier_transform(const Complex* in, Complex* out, std::size_t n, std::size_t stride,
                       const std::vector<Complex>& w) {
  if (n == 1) {
    *out = *in;
    return;
  }
  const std::size_t p = smallest_factor(n), m = n / p;
  for (std::size_t r = 0; r < p; ++r)
    fourier_transform(in + r * stride, out + r * m, m, stride * p, w);
  std::vector<Complex> part(p);
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t r = 0; r < p; ++r) part[r] = times(out[r * m + k], w[r * k * stride]);
    if (p == 2) {
      out[k] = part[0] + part[1];
      out[m + k] = part[0] - part[1];
      continue;
    }
    for (std::size_t q = 0; q < p; ++q) {
      Complex sum = part[0];
      for (std::size_t r = 1; r < p; ++r) sum += times(part[r], w[q * r % p * (w.size() / p)]);
      out[q * m + k] = sum;
    }
  }
}

}  // namespace

std::vector<Complex> half_spectrum(std::span<const double> x) {
  const std::vector<Complex> in(x.begin(), x.end());
  std::vector<Complex> out(x.size());
  if (!x.empty()) fourier_transform(in.data(), out.data(), x.size(), 1, roots_of_unity(x.size()));
  out.resize(x.size() / 2 + 1);
  return out;
}

std::vector<double> samples_of(std::span<const Complex> half, std::size_t n) {
  FLOWSLIDE_EXPECT(n > 0 && half.size() == n / 2 + 1);
  // The conjugate of the transform of the conjugates is n times the inverse.
  std::vector<Complex> in(n), out(n);
  for (std::size_t k = 0; k < n; ++k) in[k] = k < half.size() ? std::conj(half[k]) : half[n - k];
  fourier_transform(in.data(), out.data(), n, 1, roots_of_unity(n));
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = out[i].real() / static_cast<double>(n);
  return x;
}

}  // namespace flowslide

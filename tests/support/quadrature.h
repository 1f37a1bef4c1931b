#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace airlight::test {

/// An integral over one interval and how far off it may be.
struct Integral {
  double value = 0;
  double error = 0;      ///< estimate of the absolute error, rarely exceeded
  double magnitude = 0;  ///< the integral of |f|; times 1e-15 it is the least error that can be had
};

/// One Gauss-Kronrod rule (7, 15) over [a, b]: exact for polynomials up to degree 22, with the
/// error estimate of QUADPACK's qk15 (Piessens et al. 1983).
template <class Function>
Integral gauss_kronrod_15(double a, double b, Function&& f) {
  static constexpr std::array<double, 8> node = {
      0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
      0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
      0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
      0.207784955007898467600689403773245, 0};
  static constexpr std::array<double, 8> kronrod = {
      0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
      0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
      0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr std::array<double, 4> gauss = {
      // at every second node
      0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
      0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

  const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
  std::array<std::pair<double, double>, 8> values;  // left and right of the centre
  double sum = 0, coarse = 0, magnitude = 0;
  for (int i = 0; i < 8; ++i) {
    const double left = f(centre - half * node[i]);
    const double right = i < 7 ? double(f(centre + half * node[i])) : 0;
    values[i] = {left, right};
    sum += kronrod[i] * (left + right);
    magnitude += kronrod[i] * (std::abs(left) + std::abs(right));
    if (i % 2 == 1) coarse += gauss[i / 2] * (left + right);
  }
  double deviation = 0;  // the integral of |f − its mean|
  for (int i = 0; i < 8; ++i)
    deviation += kronrod[i] * (std::abs(values[i].first - 0.5 * sum) +
                               (i < 7 ? std::abs(values[i].second - 0.5 * sum) : 0));
  double error = std::abs(sum - coarse);
  if (deviation > 0 && error > 0)
    error = deviation * std::min(1., std::pow(200 * error / deviation, 1.5));
  error = std::max(error, 1e-15 * magnitude);  // rounding
  return {half * sum, std::abs(half) * error, std::abs(half) * magnitude};
}

/// The integral of f over [a, b] (a > b gives the negative), bisected where the error is largest.
///
/// Shares no code with the library, so that it can judge it. Name the places where f jumps or bends
/// in `breaks` (those outside the interval do no harm): without, each costs about 40 bisections.
/// Ends when the estimated error is below rel_tol × |integral|, when nothing but rounding is left,
/// or after 4000 intervals; the error that remains stands in the answer.
template <class Function>
Integral integrate_with_error(double a, double b, Function&& f, double rel_tol = 1e-12,
                              std::vector<double> breaks = {}) {
  if (a > b) {
    const Integral i = integrate_with_error(b, a, f, rel_tol, std::move(breaks));
    return {-i.value, i.error, i.magnitude};
  }
  std::erase_if(breaks, [&](double x) { return !(x > a && x < b); });
  breaks.push_back(a);
  breaks.push_back(b);
  std::sort(breaks.begin(), breaks.end());

  struct Piece {
    double a, b;
    Integral integral;
    bool operator<(const Piece& other) const { return integral.error < other.integral.error; }
  };
  std::priority_queue<Piece> open;  // the largest error on top
  std::vector<Piece> done;          // only rounding is left, or no number lies between the ends
  Integral total;
  const auto add = [&](double from, double to) {
    if (!(from < to)) return;
    const Piece piece = {from, to, gauss_kronrod_15(from, to, f)};
    const double middle = 0.5 * (from + to);
    const bool finished =
        piece.integral.error <= 2e-15 * piece.integral.magnitude || !(middle > from && middle < to);
    finished ? done.push_back(piece) : open.push(piece);
    total.value += piece.integral.value;
    total.error += piece.integral.error;
  };
  for (std::size_t i = 1; i < breaks.size(); ++i) add(breaks[i - 1], breaks[i]);
  while (!open.empty() && open.size() + done.size() < 4000 &&
         total.error > rel_tol * std::abs(total.value)) {
    const Piece worst = open.top();
    open.pop();
    total.value -= worst.integral.value;
    total.error -= worst.integral.error;
    const double middle = 0.5 * (worst.a + worst.b);
    add(worst.a, middle);
    add(middle, worst.b);
  }

  // Added up afresh, small ones first: the running sums have drifted by what was taken out again.
  for (; !open.empty(); open.pop()) done.push_back(open.top());
  std::sort(done.begin(), done.end(), [](const Piece& p, const Piece& q) {
    return std::abs(p.integral.value) < std::abs(q.integral.value);
  });
  total = {};
  for (const Piece& piece : done) {
    total.value += piece.integral.value;
    total.error += piece.integral.error;
    total.magnitude += piece.integral.magnitude;
  }
  return total;
}

/// As `integrate_with_error`, for those who only want the value.
template <class Function>
double integrate(double a, double b, Function&& f, double rel_tol = 1e-12,
                 std::vector<double> breaks = {}) {
  return integrate_with_error(a, b, f, rel_tol, std::move(breaks)).value;
}

}  // namespace airlight::test

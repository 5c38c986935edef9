#include "study/page/curves.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide::study {
namespace {

/// Of a history; a chart has hardly more pixels, and the page of 150 runs stays small.
constexpr std::size_t kSamples = 160;

using Kind = Curves::Kind;
const std::string kFlow = "time since transfer", kShaking = "time from the start of the motion";
const Kind kRunout{"runout", "Runout over time", kFlow, "runout", "m", "flow.t", "flow.runout"};
const Kind kFront{"front", "Front over time", kFlow, "x of the front", "m", "flow.t", "flow.front"};
/// Of each window, whose name comes behind.
const Kind kDepth{"depth ",      "Depth of liquefaction so far, ", kShaking, "depth", "m", "zone.t",
                  "zone.deepest"};
const Kind kSettlement{
    "crest down", "Settlement of the crest in the shaking", kShaking, "settlement", "m", "crest.t",
    "crest.down"};
const Kind kDownstream{"crest across",
                       "Displacement of the crest downstream in the shaking",
                       kShaking,
                       "displacement",
                       "m",
                       "crest.t",
                       "crest.across"};
const Kind kSpectrum{
    "spectrum", "Response spectrum of the motion", "period", "PSA, 5 % damping", "g", "", ""};

constexpr double kGravity = 9.81;  ///< [m/s2] as in the page of a run

}  // namespace

std::vector<double> resampled(const std::vector<double>& x, const std::vector<double>& y,
                              std::size_t count) {
  if (x.size() < 2 || y.size() != x.size() || count < 2 || !(x.back() > x.front())) return {};
  std::vector<double> out;
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = x.front() + (x.back() - x.front()) * static_cast<double>(i) /
                                      static_cast<double>(count - 1);
    while (k + 2 < x.size() && x[k + 1] < at) ++k;
    const double wide = x[k + 1] - x[k];
    const double share = wide > 0.0 ? std::clamp((at - x[k]) / wide, 0.0, 1.0) : 1.0;
    out.push_back(y[k] + share * (y[k + 1] - y[k]));
  }
  return out;
}

bool is_for_curves(std::string_view array) {
  return array == "flow.t" || array == "flow.front" || array == "flow.runout" ||
         array.starts_with("crest.") || array.starts_with("spectrum.") || array == "zone.t" ||
         array.starts_with("zone.deepest");
}

Curves::Chart& Curves::chart(const Kind& kind) {
  for (Chart& c : charts_)
    if (c.kind.name == kind.name) return c;
  Chart& c = charts_.emplace_back();
  c.kind = kind;
  c.of.assign(rows_, -1);
  return c;
}

void Curves::put(Chart& chart, std::size_t row, std::vector<double> values, double from,
                 double to) {
  // of an earlier program: a page shows curves of one length
  if (values.empty() || (!chart.curves.empty() && values.size() != chart.curves[0].size())) return;
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    if (chart.from[k] == from && chart.to[k] == to && chart.curves[k] == values) {
      chart.of[row] = static_cast<int>(k);
      return;
    }
  chart.of[row] = static_cast<int>(chart.curves.size());
  chart.curves.push_back(std::move(values));
  chart.from.push_back(from);
  chart.to.push_back(to);
}

void Curves::add(std::size_t row, const PageRun& run) {
  const auto over_time = [&](const Kind& kind, const std::string& of = "") {
    const std::vector<double>&t = run.array(kind.time), &y = run.array(kind.array + of);
    if (t.size() < 2 || y.size() != t.size()) return;
    put(chart(kind), row, resampled(t, y, kSamples), t.front(), t.back());
  };
  over_time(is_set(run.toe) ? kRunout : kFront);
  for (std::size_t w = 0; w < run.windows.size(); ++w) {
    Kind depth = kDepth;
    depth.name += run.windows[w];
    depth.title += run.windows[w];
    over_time(depth, fmt::format("{}", w));
  }
  over_time(kSettlement);
  over_time(kDownstream);
  const std::vector<double>& period = run.array("spectrum.logT");
  std::vector<double> psa = run.array("spectrum.psa");
  if (period.size() < 2 || psa.size() != period.size()) return;
  for (double& v : psa) v /= kGravity;
  put(chart(kSpectrum), row, psa, std::pow(10.0, period.front()), std::pow(10.0, period.back()));
}

bool Curves::any() const {
  return std::any_of(charts_.begin(), charts_.end(),
                     [](const Chart& c) { return !c.curves.empty(); });
}

std::string Curves::json() const {
  using CurveJson = nlohmann::ordered_json;
  const auto rounded = [](double v) { return std::round(1e4 * v) / 1e4; };
  CurveJson charts = CurveJson::array();
  for (const Chart& c : charts_) {
    if (c.curves.empty()) continue;
    CurveJson from = CurveJson::array(), to = CurveJson::array();
    for (const double v : c.from) from.push_back(rounded(v));
    for (const double v : c.to) to.push_back(rounded(v));
    const Kind& k = c.kind;
    const bool logarithmic = k.name == kSpectrum.name, downwards = k.array == kDepth.array;
    const CurveJson x{{"label", k.x}, {"unit", "s"}, {"log", logarithmic}};
    const CurveJson y{
        {"label", k.y}, {"unit", k.unit}, {"log", logarithmic}, {"invert", downwards}};
    charts.push_back({{"name", k.name},
                      {"title", k.title},
                      {"x", x},
                      {"y", y},
                      {"from", from},
                      {"to", to},
                      {"of", c.of}});
  }
  return CurveJson{{"charts", charts}, {"arrays", CurveJson::parse(packed_curves().index())}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string Curves::arrays() const { return packed_curves().text(); }

PageArrays Curves::packed_curves() const {
  PageArrays arrays;
  for (const Chart& c : charts_) {
    if (c.curves.empty()) continue;
    std::vector<double> all;
    for (const std::vector<double>& curve : c.curves)
      all.insert(all.end(), curve.begin(), curve.end());
    arrays.add(c.kind.name, all, c.curves.size());
  }
  return arrays;
}

}  // namespace flowslide::study

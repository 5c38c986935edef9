#include "study/page/chart.hpp"

#include <limits>
#include <regex>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::study;

TEST_CASE("axes have a handful of round numbers", "[study]") {
  CHECK(round_numbers(0.0, 10.0, 5) == std::vector{0.0, 2.0, 4.0, 6.0, 8.0, 10.0});
  CHECK(round_numbers(-0.35, 0.35, 7).size() == 7);
  CHECK(round_numbers(1.0, 1.0, 6).empty());
  CHECK(round_numbers(0.0, std::numeric_limits<double>::infinity(), 6).empty());
}

TEST_CASE("values that differ by rounding alone are drawn as one", "[study]") {
  // counting from 1e17 on by ones never ends
  const double depth = 10.0, same = 10.000000000000004;
  CHECK(round_numbers(depth, same, 6).empty());
  ScatterChart chart;
  chart.dots.resize(2);
  chart.dots[0].x = depth;
  chart.dots[1].x = same;
  chart.dots[1].y = 60.0;
  const std::string text = draw(chart).alone("runout");
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find(">10<") != std::string::npos);
}

TEST_CASE("The bar of the scatter keeps clear of the dots", "[study]") {
  ScatterChart chart;
  for (const double x : {0.0, 9.8, 10.0}) {
    Dot dot;
    dot.x = x;
    dot.y = 100.0;
    chart.dots.push_back(dot);
  }
  chart.usual_scatter = 5.0;
  const auto height_of_words = [&] {
    const std::string text = draw(chart).alone("runout");
    const std::size_t words = text.find("numerical scatter");
    return std::stod(text.substr(text.rfind("y='", words) + 3));
  };
  const double low = height_of_words();
  for (Dot& d : chart.dots) d.y = 1.0;  // the control: the dots down there
  chart.dots[0].y = 100.0;
  CHECK(low - height_of_words() > 100.0);
}

TEST_CASE("Thresholds that the rows do not show are not drawn", "[study]") {
  ScatterChart chart;
  for (const double x : {0.0, 5.0, 10.0}) {
    Dot dot;
    dot.x = dot.y = x;
    chart.dots.push_back(dot);
  }
  Ramp ramp;
  ramp.breach.value = 2.0;
  ramp.saturation.value = 8.0;
  ramp.plateau.value = 10.0;
  const auto corners = [&](double no_breach, double no_saturation) {
    ramp.no_breach = no_breach;
    ramp.no_saturation = no_saturation;
    chart.ramps = {{ramp, {}}};
    const std::string text = draw(chart).alone("t");
    const std::size_t fit = text.find("class='fit");
    if (fit == std::string::npos) return std::ptrdiff_t{0};
    const std::string line =
        text.substr(text.rfind('<', fit), text.find('>', fit) - text.rfind('<', fit));
    return std::count(line.begin(), line.end(), ',');
  };
  CHECK(corners(0.0, 0.0) == 4);
  CHECK(corners(0.5, 0.0) == 3);
  CHECK(corners(0.0, 0.5) == 3);
  CHECK(corners(0.5, 0.5) == 0);
}

TEST_CASE("Words of a tornado stay inside the picture", "[study]") {
  const auto swing = [](const std::string& input, double low, double high, const std::string& end) {
    Swing s;
    s.input = input;
    s.effect.low = low;
    s.effect.high = high;
    s.effect.swing = {.value = high - low};
    s.effect.low_label = "low " + end;
    s.effect.high_label = "high " + end;
    return s;
  };
  const std::string svg = draw_tornado({swing("rises", 10.0, 90.0, "of the range"),
                                        swing("falls", 95.0, 5.0, "ünderéstimated båd and lång")},
                                       kUnset, "runout [m]")
                              .alone("t");
  // x, anchor and text of each label under a bar
  const std::regex label("<text x='([0-9.]+)'[^>]*text-anchor='(start|end)'[^>]*>([^<]+)</text>");
  std::size_t seen = 0;
  for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at) {
    const double x = std::stod((*at)[1]);
    const std::string text = (*at)[3];
    if (!text.starts_with("low") && !text.starts_with("high")) continue;
    CAPTURE(text);
    const double width = 6.5 * static_cast<double>(text.size());
    CHECK(((*at)[2] == "end" ? x - width : x) >= 130.0);  // right of the names
    CHECK(((*at)[2] == "end" ? x : x + width) <= 520.0);
    ++seen;
  }
  CHECK(seen == 4);
}

TEST_CASE("runouts that are all 0 are drawn from 0 on", "[study]") {
  ScatterChart chart;
  chart.dots.resize(2);
  chart.dots[1].x = 1.0;
  // The first of its characters in a text: a tick below zero.
  const auto has_minus = [&] {
    return draw(chart).alone("runout").find(">-") != std::string::npos;
  };
  CHECK_FALSE(has_minus());
  for (Dot& d : chart.dots) d.y = -5.0;
  CHECK(has_minus());  // control: what is negative has its place
}

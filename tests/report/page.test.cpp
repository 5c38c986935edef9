#include "report/page.hpp"

#include "core/hash.hpp"
#include "report/markdown_html.hpp"
#include "report/page_arrays.hpp"
#include "report/page_points.hpp"
#include "report/page_read.hpp"
#include "report/page_thin.hpp"
#include "tests/report/dam_case.hpp"
#include "tests/support/scratch.hpp"

#include <cstdlib>
#include <map>
#include <numeric>
#include <set>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using nlohmann::json;

namespace {

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    REQUIRE(digits.find(c) != std::string::npos);
    word = (word << 6) | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out += static_cast<char>((word >> bits) & 0xff);
  }
  return out;
}

/// What page/arrays.js does, written from its description.
std::map<std::string, std::vector<double>> unpacked(const json& index, const std::string& text) {
  const std::string deflated = from_base64(text);
  std::size_t total = 0;
  for (const json& e : index)
    total += e["rows"].get<std::size_t>() * e["columns"].get<std::size_t>() *
             (e["bits"].get<std::size_t>() / 8);
  std::vector<unsigned char> bytes(total + 1);
  uLongf size = total + 1;
  REQUIRE(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(deflated.data()),
                     static_cast<uLong>(deflated.size())) == Z_OK);
  REQUIRE(size == total);
  std::map<std::string, std::vector<double>> out;
  std::size_t at = 0;
  for (const json& e : index) {
    const std::size_t rows = e["rows"], columns = e["columns"], n = rows * columns;
    const bool wide = e["bits"] == 16;
    const unsigned mask = wide ? 0xffff : 0xff;
    std::vector<unsigned> level(n);
    std::vector<double>& values = out[e["name"]];
    for (std::size_t i = 0; i < n; ++i) {
      const unsigned z = bytes[at + i] | (wide ? bytes[at + n + i] << 8 : 0u);
      const unsigned difference = z & 1 ? ~(z >> 1) : z >> 1;
      const std::size_t row = i / columns, column = i % columns;
      const unsigned above = row ? level[i - columns] : 0;
      const unsigned left = column ? level[i - 1] : 0;
      const unsigned corner = row && column ? level[i - columns - 1] : 0;
      level[i] = (above + left - corner + difference) & mask;
      values.push_back(level[i] == mask
                           ? kUnset
                           : e["lowest"].get<double>() + level[i] * e["step"].get<double>());
    }
    at += n * (wide ? 2 : 1);
  }
  return out;
}

constexpr const char* kAudit = R"({"passed": true, "checks": []})";

struct PageCase {
  Scratch scratch;
  QuadMesh mesh = dam_case::mesh();
  ParticleSet particles = dam_case::particles();
  ReportConfig config;
  LiquefactionZone zone = dam_case::zone(mesh, true);
  std::vector<std::string> warnings;
  std::vector<ToldStage> stages;
  std::optional<GroundMotion> motion;
  dam_case::Flow moves;

  PageCase() { scratch.write("audit.json", kAudit); }
  [[nodiscard]] std::string page() const {
    dam_case::write_flow(scratch / "mpm.h5", particles, moves);
    dam_case::write_history(scratch / "history.h5", true);
    const FemHistory history(scratch / "history.h5");
    const MpmHistory flow(scratch / "mpm.h5");
    const ReportInputs in{.history = history,
                          .zone = zone,
                          .particles = particles,
                          .audit = scratch / "audit.json",
                          .flow = flow,
                          .provenance = {{"program", "flowslide 9.9 (abc)"}},
                          .warnings = warnings,
                          .stages = stages,
                          .motion = motion,
                          .date = "2026-11-28"};
    const FinalState end = final_state(particles, flow, config);
    return report_page(in, config, compute_facts(zone, flow, end, config), end);
  }
};

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t a = text.find(from);
  REQUIRE(a != std::string::npos);
  const std::size_t b = text.find(to, a + from.size());
  REQUIRE(b != std::string::npos);
  return text.substr(a + from.size(), b - a - from.size());
}

json data_of(const std::string& page) {
  return json::parse(between(page, "id=\"run\">", "</script>"));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
  return n;
}

/// Names of elements that are not closed in their turn; empty for a page that is nested well.
std::string badly_nested(std::string page) {
  const std::set<std::string> empty{"meta", "!doctype", "br", "img"};
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos;) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "a tag has no end";
    const bool closes = page[at + 1] == '/';
    std::string name = page.substr(at + 1 + closes, end - at - 1 - closes);
    name = name.substr(0, name.find_first_of(" \n"));
    at = end + 1;
    if (closes) {
      if (open.empty() || open.back() != name) return name;
      open.pop_back();
    } else if (!empty.contains(name)) {
      open.push_back(name);
      // What is in them is no markup.
      if (name == "script" || name == "style") at = page.find("</" + name, at);
    }
  }
  return open.empty() ? "" : open.back();
}

}  // namespace

TEST_CASE("Numbers of a page come back within half a step") {
  PageArrays arrays;
  std::vector<double> wave, walk, gaps{1.0, kUnset, -3.0, kUnset};
  for (int row = 0; row < 7; ++row)
    for (int i = 0; i < 50; ++i) wave.push_back(40.0 * std::sin(0.3 * i + row) + 100.0 * row);
  for (int i = 0; i < 300; ++i) walk.push_back(i * i % 256);
  arrays.add("wave", wave, 7);
  arrays.add("coarse", wave, 7, Bits::sixteen, 0.5);
  arrays.add("eight", wave, 7, Bits::eight);
  arrays.add("walk", walk, 3, Bits::sixteen, 1.0);
  arrays.add("gaps", gaps, 2);
  arrays.add("same", std::vector<double>{2.0, 2.0});
  arrays.add("none", std::vector<double>{kUnset, kUnset});
  const json index = json::parse(arrays.index());
  auto back = unpacked(index, arrays.text());
  const double range = 680.0;
  for (const auto& [name, bound] :
       {std::pair{"wave", range / 65534 / 2}, {"coarse", 0.25}, {"eight", range / 254 / 2}}) {
    CAPTURE(name);
    double worst = 0.0;
    for (std::size_t i = 0; i < wave.size(); ++i)
      worst = std::max(worst, std::abs(back[name][i] - wave[i]));
    CHECK(worst <= bound * (1.0 + 1e-9));
    CHECK(worst > 0.1 * bound);  // control: it is quantised
  }
  CHECK(back["walk"] == walk);  // integers with a step of one are exact
  CHECK(back["gaps"][0] == Approx(1.0));
  CHECK(back["gaps"][2] == -3.0);
  CHECK(std::isnan(back["gaps"][1]));
  CHECK(std::isnan(back["gaps"][3]));
  CHECK(back["same"] == std::vector<double>{2.0, 2.0});
  CHECK(std::isnan(back["none"][0]));
  CHECK_THROWS_AS(arrays.add("far", std::vector<double>{1.0, 1.0 / 0.0}), NumericsError);
}

TEST_CASE("Base64 is that of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
}

TEST_CASE("Frames are chosen where the flow is fast") {
  std::vector<double> times;
  std::vector<MpmSample> samples;
  for (int k = 0; k <= 200; ++k) {
    times.push_back(0.5 * k);
    MpmSample s;
    s.time = 0.5 * k;
    s.max_speed = s.time < 10.0 ? 20.0 : 0.2;
    samples.push_back(s);
  }
  const auto chosen = choose_frames(times, samples, 20);
  REQUIRE(chosen.size() == 20);
  CHECK(chosen.front() == 0);
  CHECK(chosen.back() == 200);
  CHECK(std::is_sorted(chosen.begin(), chosen.end()));
  const auto early =
      std::count_if(chosen.begin(), chosen.end(), [&](auto f) { return times[f] < 10.0; });
  CHECK(early >= 13);  // 200 of 218 m in 10 of 100 s: 0.75 * 0.92 + 0.25 * 0.1 = 71 % of the way
  CHECK(choose_frames(times, samples, 500).size() == times.size());
  CHECK(choose_frames(times, samples, 2) == std::vector<std::size_t>{0, 200});
  for (MpmSample& s : samples) s.max_speed = 0.0;  // nothing moves: equal in time
  const auto still = choose_frames(times, samples, 5);
  CHECK(still == std::vector<std::size_t>{0, 50, 100, 150, 200});
}

TEST_CASE("A choice of points is even and keeps what it must") {
  std::vector<std::array<double, 3>> x;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) x.push_back({1.0 * i, 1.0 * j, 0.0});
  const auto all = choose_points(x, {}, 5000);
  CHECK(all.size() == x.size());
  CHECK(std::set(all.begin(), all.end()).size() == x.size());
  const auto some = choose_points(x, {4095, 7}, 1024);
  CHECK(some.size() <= 1024);
  CHECK(some.size() >= 1020);
  CHECK(std::count(some.begin(), some.end(), 4095u) == 1);
  CHECK(std::count(some.begin(), some.end(), 7u) == 1);
  std::map<std::pair<int, int>, int> of_cell;  // 8 by 8 points each
  for (const auto i : some) ++of_cell[{int(x[i][0]) / 8, int(x[i][1]) / 8}];
  CHECK(of_cell.size() == 64);
  for (const auto& [cell, points] : of_cell) CHECK(std::abs(points - 16) <= 2);
}

TEST_CASE("A page holds the run: its numbers come back from the file") {
  PageCase c;
  GroundMotion shock{.dt = 0.01, .acceleration = {}, .origin = "a shock"};
  for (int i = 0; i < 400; ++i) shock.acceleration.push_back(2.0 * std::sin(0.1 * i));
  c.motion = shock;
  c.stages = {
      {"flow", "mpm.run", "cell = 2.5 m\nground.surface = [[-10 m, -5 m], [80 m, 0 m]]\n", "{}"}};
  const std::string page = c.page();
  CHECK(badly_nested(page) == "");
  CHECK(page.size() < 1'000'000);
  const json run = data_of(page);
  auto back = unpacked(run["arrays"], between(page, "id=\"arrays\">", "</script>"));
  CHECK(run["ground"] == json::parse("[[-10.0, -5.0], [80.0, 0.0]]"));
  CHECK(run["points"]["shown"] == c.particles.size());
  CHECK(run["points"]["frames"] == 3);
  REQUIRE(back["points.t"].size() == 3);
  CHECK(back["points.t"][2] == Approx(40.0));
  REQUIRE(back["motion.a"].size() == 400);
  CHECK(back["motion.a"][16] == Approx(2.0 * std::sin(1.6)).margin(1e-4));
  // The order of points is the page's own: the mean is that of the flow.
  double mean = 0.0, shown = 0.0;
  for (const auto& x : c.particles.position) mean += dam_case::flowed(x, 200.0, 1.0)[0];
  const std::size_t n = c.particles.size();
  for (std::size_t i = 0; i < n; ++i) shown += back["points.x"][2 * n + i];
  CHECK(shown / double(n) == Approx(mean / double(n)).margin(dam_case::kSpacing / 64));
  double far = -1e9;
  for (const auto& x : c.particles.position)
    far = std::max(far, dam_case::flowed(x, 200.0, 1.0)[0]);
  const auto last = back["points.x"].begin() + static_cast<std::ptrdiff_t>(2 * n);
  CHECK(*std::max_element(last, back["points.x"].end()) ==
        Approx(far).margin(dam_case::kSpacing / 64));
}

TEST_CASE("Fewer points and frames are said, and the tip is among them") {
  PageCase c;
  c.config.page_points = 200;
  c.config.page_frames = 2;
  const std::string page = c.page();
  const json run = data_of(page);
  CHECK(run["points"]["shown"] <= 200);
  CHECK(run["points"]["of"] == c.particles.size());
  CHECK(run["points"]["frames"] == 2);
  auto back = unpacked(run["arrays"], between(page, "id=\"arrays\">", "</script>"));
  double far = -1e9, shown = -1e9;
  for (std::size_t i = 0; i < c.particles.size(); ++i)
    if (c.particles.material[i] != 0)
      far = std::max(far, dam_case::flowed(c.particles.position[i], 200.0, 1.0)[0]);
  for (const double x : back["points.x"]) shown = std::max(shown, x);
  CHECK(shown == Approx(far).margin(0.1));
}

TEST_CASE("Text of a workflow is text in the page") {
  const std::string evil = "</script><script>alert(1)</script><img src=x onerror='a()'>\"& -->";
  PageCase c;
  c.config.title = evil;
  c.particles.materials[1].name = evil;
  c.zone.window_names[0] = c.zone.history.window_names[0] = evil;
  c.zone.transfer_reason = evil;
  c.warnings = {evil};
  c.config.regions[evil].outline = {{0, 0}, {75, 0}, {35, 12}};
  c.stages = {{evil, "mpm.run", "cell = " + evil + "\nmaterials.\"" + evil + "\".tag = 3\n", "{}"},
              {"map", "transfer.map", "materials.\"<b>\".x = <i>\n", evil}};
  c.scratch.write("audit.json", json{{"passed", true}, {evil, evil}}.dump());
  const std::string page = c.page();
  CHECK(count(page, "<script") == 3);
  CHECK(count(page, "</script") == 3);
  CHECK(count(page, "<img") == 0);
  CHECK(count(page, "<b>") == 0);
  CHECK(count(page, "<!--") == 0);
  CHECK(badly_nested(page) == "");
  const json run = data_of(page);
  CHECK(run["materials"][1]["name"] == evil);
  CHECK(run["windows"][0] == evil);
  // And if something slipped through, the browser would not run it.
  const std::string script = between(page, "<script>", "</script>");
  const std::string hex = sha256(script);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  CHECK(count(page, "default-src 'none'; script-src 'sha256-" + base64(bytes) + "';") == 1);
}

TEST_CASE("A page loads nothing") {
  const std::string page = PageCase{}.page();
  for (const char* part : {"src=", "href=\"http", "@import", "fetch(", "XMLHttpRequest"}) {
    CAPTURE(part);
    CHECK(count(page, part) == 0);
  }
  CHECK(count(page, "url(") == count(page, "url(#"));  // places in the page itself
}

TEST_CASE("Markdown of the report becomes HTML") {
  CHECK(markdown_html("## A & b\n\nfirst **bold** `x<y`\nsecond\n\n- one\n- two\n") ==
        "<h3>A &amp; b</h3>\n<p>first <strong>bold</strong> <code>x&lt;y</code>\nsecond</p>\n"
        "<ul>\n<li>one</li>\n<li>two</li>\n</ul>\n");
  CHECK(markdown_html("| a | b |\n|---|---:|\n| x\\|y | -1.5 m |\n") ==
        "<div class=\"scroll\"><table><thead><tr><th>a</th><th>b</th></tr>\n</thead><tbody>\n"
        "<tr><td>x|y</td><td class=\"n\">-1.5 m</td></tr>\n</tbody></table></div>\n");
  CHECK(markdown_html("![p](x.png)\n") == "");
  CHECK(markdown_html("| no table") == "<p>| no table</p>\n");
  CHECK(markdown_html("a ** b ` c") == "<p>a ** b ` c</p>\n");
}

TEST_CASE("A player with fewer states shows those that are left as before", "[report]") {
  const std::string full = PageCase().page();
  const auto run_of = [](const std::string& html) {
    return json::parse(between(html, "id=\"run\">", "</script>"));
  };
  const auto numbers_of = [&](const std::string& html) {
    return unpacked(run_of(html)["arrays"], between(html, "id=\"arrays\">", "</script>"));
  };
  REQUIRE(page_states(full) == 3);
  CHECK(thinned_page(full, 3) == full);
  const std::string thin = thinned_page(full, 2);
  CHECK(page_states(thin) == 2);
  CHECK(thin.size() < full.size());
  const auto before = numbers_of(full), after = numbers_of(thin);
  REQUIRE(before.size() == after.size());
  // of the instants 0, 20 and 40 s the middle one goes
  CHECK(after.at("points.t") == std::vector{before.at("points.t")[0], before.at("points.t")[2]});
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (const char* name : {"points.x", "points.y", "points.speed", "points.strength"}) {
    const std::vector<double>&all = before.at(name), &some = after.at(name);
    const std::size_t points = all.size() / 3;
    REQUIRE(some.size() == 2 * points);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < points; ++i)
      differ += !same(some[i], all[i]) + !same(some[points + i], all[2 * points + i]);
    CHECK(differ == 0);
  }
  for (const char* name : {"points.x0", "flow.front", "mesh.x", "zone.t"})
    CHECK(after.at(name) == before.at(name));
  CHECK(thinned_page("<p>another page</p>", 2) == "<p>another page</p>");
  std::string damaged = full;
  damaged.replace(damaged.find("id=\"arrays\">") + 13, 40, 40, 'A');
  CHECK_THROWS_AS(thinned_page(damaged, 2), InputError);
}

TEST_CASE("A page of a run is read back", "[report]") {
  const std::string html = PageCase().page();
  const auto run_json = json::parse(between(html, "id=\"run\">", "</script>"));
  const auto stored = unpacked(run_json["arrays"], between(html, "id=\"arrays\">", "</script>"));
  const auto run = read_page(html, [](std::string_view name) { return name != "points.x"; });
  REQUIRE(run);
  CHECK(run->toe == dam_case::kToe);
  CHECK(run->front == Approx(run_json["front_m"].get<double>()));
  CHECK(run->windows == std::vector<std::string>{"crest", "pond"});
  // beneath the pond, which stands at 30
  CHECK(run->water.front()[1] == Approx(30.0).margin(0.01));
  CHECK(run->array("points.x").empty());
  for (const char* name : {"flow.front", "mesh.x", "zone.depth1", "mesh.corners"}) {
    REQUIRE(run->array(name).size() == stored.at(name).size());
    for (std::size_t i = 0; i < stored.at(name).size(); ++i)
      CHECK(run->array(name)[i] == Approx(stored.at(name)[i]));
  }
  CHECK(run->array("flow.front").front() == Approx(dam_case::kToe).margin(15.0));
  const auto any = [](std::string_view) { return true; };
  CHECK_FALSE(read_page("<p>another page</p>", any));
  std::string damaged = html;
  damaged.replace(damaged.find("id=\"arrays\">") + 13, 40, 40, 'A');
  CHECK_THROWS_AS(read_page(damaged, any), InputError);
}

TEST_CASE("Child of the browser test: writes a page", "[.page-child]") {
  PageCase c;
  c.config.title = "Dam <of> the \"test\" & more";
  c.warnings = {"shake: a warning of a stage."};
  GroundMotion shock{.dt = 0.01, .acceleration = {}, .origin = "a shock"};
  for (int i = 0; i < 400; ++i) shock.acceleration.push_back(2.0 * std::sin(0.1 * i));
  c.motion = shock;
  c.stages = {{"flow", "mpm.run",
               "cell = 2.5 m\nground.surface = [[-140 m, -5 m], [85 m, -5 m], "
               "[85 m, 0 m]]\n",
               "{}"}};
  const char* out = std::getenv("FLOWSLIDE_PAGE");
  REQUIRE(out);
  if (const char* end = std::getenv("FLOWSLIDE_PAGE_END")) c.moves.end = std::stod(end);
  std::ofstream(out) << c.page();
}

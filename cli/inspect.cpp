#include "exchange/inspect.hpp"

#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide::cli {
namespace {

/// Text of a file from somewhere must not steer the terminal.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }, '?');
  return text;
}

/// How far a long look has come, on a terminal only, and gone when it is over.
class Look {
 public:
  [[nodiscard]] std::function<void(double)> tick() {
    if (isatty(STDERR_FILENO) == 0) return {};
    return [this](double share) {
      const int percent = static_cast<int>(100.0 * share);
      const auto now = std::chrono::steady_clock::now();
      if (percent == shown_ || now - start_ < std::chrono::seconds(1)) return;
      shown_ = percent;
      fmt::print(stderr, "\r\033[Kreading {:>3} %", percent);
      std::fflush(stderr);
    };
  }
  ~Look() {
    if (shown_ >= 0) fmt::print(stderr, "\r\033[K");
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  int shown_ = -1;
};

/// Six digits are what a reader takes in; --json has them all.
std::string shown(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::vector<std::string> parts;
  for (const Json& part : value) parts.push_back(shown(part));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

void print(const Json& json, const std::string& indent) {
  for (const auto& [name, value] : json.items()) {
    const std::string key = printable(name);
    if (value.is_object()) {
      fmt::print("{}{}\n", indent, key);
      print(value, indent + "  ");
    } else if (value.is_array() && !value.empty() && value[0].is_string()) {
      fmt::print("{}{}\n", indent, key);
      for (const Json& line : value)
        print_wrapped(stdout, indent + "  ", printable(line.get<std::string>()));
    } else if (value.is_string()) {
      print_row(stdout, fmt::format("{}{:<24} ", indent, key), printable(value.get<std::string>()));
    } else if (!value.is_array() || !value.empty()) {
      print_row(stdout, fmt::format("{}{:<24} ", indent, key), shown(value));
    }
  }
}

}  // namespace

void add_inspect(CLI::App& app, Command& action) {
  auto path = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("inspect", "Say what a file or run folder is");
  command->add_option("path", *path, "file or folder")->required()->check(input_name());
  command->add_flag("--json", *json, "as JSON");
  command->callback([path, json, &action] {
    action = [path, json] {
      Json result = {{"path", *path}};
      {
        Look look;
        result.update(inspect(*path, look.tick()));
      }
      if (*json)
        fmt::print("{}\n", result.dump(2, ' ', false, Json::error_handler_t::replace));
      else
        print(result, "");
      if (result["problems"].empty()) return 0;
      // Problems of a run folder are files that are not what was written, those of a text are its
      // own; results only remember what was odd about where they come from.
      if (result["kind"] == "run") return 4;
      const std::string kind = result["kind"];
      const bool text =
          kind == "recorder" || kind == "workflow" || kind == "terrain" || kind == "record";
      return text ? 2 : 0;
    };
  });
}

}  // namespace flowslide::cli

#include "exchange/convert.hpp"

#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {

void add_convert(CLI::App& app, Command& action) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Convert between supported formats");
  command->footer("Conversions:" + known_conversions());
  command->add_option("in", options->in, "file or folder")->required()->check(input_name());
  command->add_option("out", options->out, "file, whose ending says the format, or folder")
      ->required()
      ->check(output_name());
  command
      ->add_option("--unit", options->format.unit,
                   "acceleration unit of records that do not state it: g, cm/s2, m/s2")
      ->check(some_value());
  command->callback([options, &action] {
    action = [options] {
      check_unit(options->format.unit);
      refuse_same_file(options->in, options->out);
      const Converted done = convert(*options);
      for (const std::string& note : done.notes) print_wrapped(stderr, "note: ", note);
      for (const std::string& warning : done.warnings) print_warning(warning);
      fmt::print("{}\n", options->out);
      return 0;
    };
  });
}

}  // namespace flowslide::cli

#pragma once
#include <optional>
#include <string>

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

/// What is wrong about a command line, and the nearest to what was written.
namespace flowslide::cli {

/// Throws InputError for a first word, or one after a command that has its own, that is no command.
void check_commands(const CLI::App& app, int argc, char** argv);

/// The text of an error of the command line: of an unknown option with the nearest one, of words
/// that were left over with a guess at why.
std::string usage_problem(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error);

/// Refuses names under which nothing should be written: none at all, and '~', which the shell
/// leaves alone in quotes and after '='.
CLI::Validator output_name();

/// Throws InputError, naming --unit, for what is no unit of acceleration.
void check_unit(const std::optional<std::string>& unit);

/// Throws InputError if what is to be written is the file that is read.
void refuse_same_file(const std::string& in, const std::string& out);

/// Refuses a value of an option that is empty or blank.
CLI::Validator some_value();

/// Refuses names of what should be read that are empty or blank.
CLI::Validator input_name();

}  // namespace flowslide::cli

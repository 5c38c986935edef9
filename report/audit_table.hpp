#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace flowslide {

/// The audit of a transfer as Markdown: lists of objects become tables with their keys as columns,
/// the rest a list of values. It shows whatever the audit holds, so a new check needs no change
/// here. Throws FileError, and InputError if the file is not a JSON object.
std::string audit_tables(const std::filesystem::path& audit);

/// Text safe inside a cell of a Markdown table.
std::string cell(std::string_view text);

}  // namespace flowslide

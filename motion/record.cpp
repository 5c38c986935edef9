#include "motion/record.hpp"

#include "motion/at2.hpp"
#include "motion/columns.hpp"
#include "motion/record_text.hpp"

namespace flowslide {
namespace {

Record parse(const RecordText& text, const RecordFormat& format) {
  Record record = is_at2(text) ? parse_at2(text, format) : parse_columns(text, format);
  check(record.motion);
  return record;
}

}  // namespace

Record read_record(const std::filesystem::path& path, const RecordFormat& format) {
  return parse(read_record_text(path), format);
}

Record parse_record(std::string_view text, std::string name, const RecordFormat& format) {
  return parse(record_text(text, std::move(name)), format);
}

}  // namespace flowslide

#include "motion/record.hpp"

#include "motion/at2.hpp"
#include "motion/columns.hpp"
#include "motion/foreign.hpp"
#include "motion/measures.hpp"
#include "motion/record_text.hpp"

namespace flowslide {
namespace {

Record parse(const RecordText& text, const RecordFormat& format) {
  if (!is_at2(text)) refuse_foreign_format(text);
  Record record = is_at2(text) ? parse_at2(text, format) : parse_columns(text, format);
  check(record.motion);
  for (std::string& odd : implausible(text.name, pga(record.motion), record.motion.dt))
    record.warnings.push_back(std::move(odd));
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

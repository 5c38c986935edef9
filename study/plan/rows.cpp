#include "study/plan/rows.hpp"

#include <algorithm>

namespace flowslide::study {
namespace {

constexpr std::size_t kMostRows = 100000;

void add(Draft& row, const std::string& name, const std::string& place, const Choice& choice) {
  row.values.emplace_back(name, choice.label);
  for (std::size_t i = 0; i < choice.set.size(); ++i) {
    row.set.push_back(choice.set[i]);
    row.places.push_back(choice.places.empty() ? place : choice.places[i]);
  }
}

std::vector<Draft> varied(const std::vector<Draft>& rows, const Variable& variable) {
  std::vector<Draft> more;
  for (const Draft& row : rows)
    for (const Choice& choice : variable.choices)
      add(more.emplace_back(row), variable.name, variable.place, choice);
  return more;
}

std::vector<Draft> sampled(const std::vector<Draft>& rows, const Sample& sample) {
  const auto points = sample_points(sample.method, sample.count, sample.inputs.size(), sample.seed,
                                    sample.correlations);
  std::vector<Draft> more;
  for (const Draft& row : rows)
    for (const auto& point : points) {
      Draft& next = more.emplace_back(row);
      for (std::size_t i = 0; i < sample.inputs.size(); ++i) {
        const SampledInput& input = sample.inputs[i];
        const std::string text =
            to_text(Amount{quantile(input.distribution, point[i]), input.unit});
        Choice choice{text, {}, {}};
        for (const std::string& path : input.settings) choice.set.emplace_back(path, text);
        add(next, input.name, input.place, choice);
      }
    }
  return more;
}

bool is_repeated(const Draft& row, const Repeat& repeat) {
  return std::all_of(repeat.rows.begin(), repeat.rows.end(), [&](const auto& wanted) {
    return std::any_of(row.values.begin(), row.values.end(), [&](const auto& value) {
      return value.first == wanted.first && std::find(wanted.second.begin(), wanted.second.end(),
                                                      value.second) != wanted.second.end();
    });
  });
}

}  // namespace

std::vector<Draft> expand(const StudyFile& study) {
  std::vector<Draft> all;
  for (const Part& part : study.parts) {
    Draft first{.part = &part, .values = {}, .set = part.set, .places = part.places, .repeat = 0};
    std::vector<Draft> rows{first};
    const auto expect_few = [&](std::size_t factor) {
      validate(rows.size() * factor + all.size() <= kMostRows,
               "{}: more than {} rows (their table could not be used) vary less",
               study.file.string(), kMostRows);
    };
    for (const Variable& variable : part.vary) {
      expect_few(variable.choices.size());
      rows = varied(rows, variable);
    }
    if (part.sample) {
      expect_few(part.sample->count);
      rows = sampled(rows, *part.sample);
    }
    expect_few(part.repeat ? part.repeat->count : 1);
    for (const Draft& row : rows) {
      const std::size_t count =
          part.repeat && is_repeated(row, *part.repeat) ? part.repeat->count : 1;
      for (std::size_t k = 0; k < count; ++k) all.emplace_back(row).repeat = k;
    }
  }
  return all;
}

}  // namespace flowslide::study

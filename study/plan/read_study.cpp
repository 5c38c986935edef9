#include "core/files.hpp"
#include "study/plan/read_parts.hpp"
#include "study/plan/yaml_read.hpp"
#include "workflows/engine/names.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

const std::vector<std::string> kStudyKeys{"workflow", "set",  "vary",   "sample", "repeat",  "also",
                                          "keep",     "disk", "limits", "slurm",  "analysis"};

/// Each name stands for one column of the table.
void expect_names(const Part& part, const YamlNode& node) {
  std::set<std::string> seen{"row", "id", "variant", "repeat", "state", "cause"};
  const auto take = [&](const std::string& name) {
    if (!is_name(name))
      throw node.error(
          fmt::format("'{}' cannot be the name of a variable (it is a column of the "
                      "table). Use letters, digits, '-' and '_'.",
                      name));
    if (!seen.insert(name).second)
      throw node.error(fmt::format("there are two columns '{}'. Choose another name.", name));
  };
  for (const Variable& v : part.vary) take(v.name);
  if (part.sample)
    for (const SampledInput& i : part.sample->inputs) take(i.name);
  if (!part.repeat) return;
  for (const auto& [name, labels] : part.repeat->rows) {
    const auto variable =
        std::find_if(part.vary.begin(), part.vary.end(),
                     [&, &name = name](const Variable& v) { return v.name == name; });
    if (variable == part.vary.end())
      throw InputError(fmt::format("{}: there is no variable '{}'. Name one of 'vary'.",
                                   part.repeat->place, name));
    for (const std::string& label : labels)
      if (std::none_of(variable->choices.begin(), variable->choices.end(),
                       [&](const Choice& c) { return c.label == label; }))
        throw InputError(
            fmt::format("{}: '{}' is no value of '{}'. Take one as it is written there.",
                        part.repeat->place, label, name));
  }
}

/// Is `inner` a setting within the group `outer`?
bool lies_in(const std::string& inner, const std::string& outer) {
  return inner.starts_with(outer + ".");
}

/// Of two that set one setting the table would show the one that did not act.
void expect_settings_once(const Part& part) {
  struct Setter {
    std::string name, place, path;
  };
  std::vector<Setter> setters;
  for (const Variable& v : part.vary)
    for (const std::string& path : v.settings) setters.push_back({v.name, v.place, path});
  if (part.sample)
    for (const SampledInput& i : part.sample->inputs)
      for (const std::string& path : i.settings) setters.push_back({i.name, i.place, path});
  for (std::size_t a = 0; a < setters.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto& [name, place, path] = setters[a];
      const Setter& other = setters[b];
      if (path == other.path || lies_in(path, other.path) || lies_in(other.path, path))
        throw InputError(fmt::format(
            "{}: '{}' sets {}, and '{}' sets {} ({}): only one of them would act, and the table "
            "would show both. Take one away, or vary them together with 'zip'.",
            place, name, path, other.name, other.path, other.place));
    }
  for (std::size_t i = 0; i < part.set.size(); ++i) {
    const std::string& path = part.set[i].first;
    for (const Setter& s : setters)
      if (lies_in(path, s.path))
        throw InputError(fmt::format(
            "{}: {} is set here, but '{}' replaces all of {} ({}). Write it into its values.",
            part.places[i], path, s.name, s.path, s.place));
    for (std::size_t k = 0; k < part.set.size(); ++k)
      if (lies_in(path, part.set[k].first))
        throw InputError(
            fmt::format("{}: {} is set here, and all of {} as well ({}). Write it there.",
                        part.places[i], path, part.set[k].first, part.places[k]));
  }
}

/// Adds a part with its workflow to the study; `above` gives what it does not say itself.
void add_part(StudyFile& study, const YamlNode& node, const std::string& variant,
              const YamlNode& workflow, Part above) {
  if (!is_name(variant))
    throw node.error(
        fmt::format("'{}' cannot be the name of a variant (it stands in the table). Use letters, "
                    "digits, '-' and '_'.",
                    variant));
  if (std::any_of(study.parts.begin(), study.parts.end(),
                  [&](const Part& part) { return part.variant == variant; }))
    throw node.error(fmt::format(
        "there are two variants '{}' (their rows could not be told apart). Choose another name.",
        variant));
  Part& part = study.parts.emplace_back(std::move(above));
  part.variant = variant;
  part.workflow = (workflow.folder() / workflow.scalar()).lexically_normal();
  if (const auto vary = node.find("vary")) part.vary = read_vary(*vary);
  if (const auto sample = node.find("sample")) part.sample = read_sample(*sample);
  if (const auto repeat = node.find("repeat")) part.repeat = read_repeat(*repeat);
  expect_names(part, node);
  expect_settings_once(part);
  try {
    expect_regular_file(part.workflow);
  } catch (const FileError& e) {
    throw FileError(workflow.error(e.what()).what());
  }
}

void read_parts(StudyFile& study, const YamlNode& node) {
  const YamlNode workflow = need(node, "workflow", "a study varies a workflow");
  const bool several = workflow.kind() == YamlNode::Kind::map;
  Part above;
  if (const auto given = node.find("set")) read_set(*given, above);
  if (several) {
    for (const auto& [name, path] : workflow.entries()) add_part(study, node, name, path, above);
    if (study.parts.empty())
      throw workflow.error("is empty (a study varies a workflow). Name one.");
  } else {
    add_part(study, node, "base", workflow, above);
  }
  const auto also = node.find("also");
  if (!also) return;
  for (const auto& [name, more] : also->entries()) {
    allow_keys(more, {"workflow", "set", "vary", "sample", "repeat"});
    const auto own = more.find("workflow");
    if (!own && several) throw more.error("has no 'workflow' (the study has several). Name one.");
    Part from = own ? Part{} : above;
    if (const auto given = more.find("set")) read_set(*given, from);
    add_part(study, more, name, own.value_or(workflow), std::move(from));
  }
}

void read_limits(StudyFile& study, const YamlNode& node) {
  allow_keys(node, {"stage_time"});
  if (const auto time = node.find("stage_time")) study.limits.stage_seconds = read_time(*time);
}

void read_analysis(StudyFile& study, const YamlNode& node) {
  allow_keys(node, {"results", "thresholds", "seed"});
  if (const auto results = node.find("results")) {
    study.analysis.results = read_texts(*results);
    const auto take = [&](const YamlNode& name) {
      study.analysis.places.emplace(name.scalar(), place_of(name));
    };
    for (std::size_t i = 0; i < results->size(); ++i) take(results->item(i));
    if (results->kind() != YamlNode::Kind::list) take(*results);
  }
  if (const auto seed = node.find("seed"))
    study.analysis.seed = read_count(*seed, 0, static_cast<std::size_t>(1) << 62u);
  const auto pairs = node.find("thresholds");
  if (pairs && pairs->kind() != YamlNode::Kind::list)
    throw pairs->error("is no list of pairs. Write [[x, y]].");
  if (pairs)
    for (std::size_t i = 0; i < pairs->size(); ++i) {
      const YamlNode pair = pairs->item(i);
      if (pair.size() != 2) throw pair.error("is no pair of columns. Write [x, y].");
      study.analysis.thresholds.emplace_back(pair.item(0).scalar(), pair.item(1).scalar());
      for (const std::size_t k : {0, 1})
        study.analysis.places.emplace(pair.item(k).scalar(), place_of(pair.item(k)));
    }
}

}  // namespace

StudyFile read_study(const std::filesystem::path& path) {
  const YamlNode document = load_yaml(path);
  if (document.kind() == YamlNode::Kind::map && document.find("stages") && !document.find("study"))
    throw document.error(
        "is a workflow (a study names one). Run it with 'flowslide run', or write "
        "a study: docs/guide/studies.md.");
  allow_keys(document, {"schema", "name", "description", "study"});
  StudyFile study;
  study.file = path;
  const YamlNode schema = need(document, "schema", "the version of its format");
  if (schema.scalar() != "1")
    throw schema.error(
        fmt::format("schema {} is not known to this program (it reads 1).", schema.scalar()));
  const YamlNode name = need(document, "name", "results are kept under it");
  study.name = name.scalar();
  if (!is_name(study.name))
    throw name.error(
        fmt::format("'{}' cannot be a name (it becomes a folder). Use letters, digits, "
                    "'-' and '_'.",
                    study.name));
  if (const auto text = document.find("description")) study.description = text->scalar();
  const YamlNode node = need(document, "study", "nothing to run");
  allow_keys(node, kStudyKeys);
  read_parts(study, node);
  if (const auto keep = node.find("keep")) {
    const auto at = std::find(kKeeps.begin(), kKeeps.end(), keep->scalar());
    if (at == kKeeps.end())
      throw keep->error(fmt::format("'{}' is nothing to keep. Take one of {}.", keep->scalar(),
                                    fmt::join(kKeeps, ", ")));
    study.keep = static_cast<Keep>(at - kKeeps.begin());
  }
  if (const auto disk = node.find("disk")) study.disk_bytes = read_bytes(*disk);
  if (const auto limits = node.find("limits")) read_limits(study, *limits);
  if (const auto slurm = node.find("slurm")) study.slurm = read_slurm(*slurm);
  if (const auto analysis = node.find("analysis")) read_analysis(study, *analysis);
  return study;
}

}  // namespace flowslide::study

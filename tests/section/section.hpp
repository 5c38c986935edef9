#pragma once
#include "config/yaml.hpp"
#include "section/section_config.hpp"
#include "tests/model/scratch.hpp"
#include "tests/support/paths.hpp"

/// Settings of a section from YAML text.
inline flowslide::SectionConfig section_of(const std::string& yaml) {
  const Scratch scratch;
  put_bytes(scratch / "section.yaml", yaml);
  return flowslide::read_settings<flowslide::SectionConfig>(
      flowslide::load_yaml(scratch / "section.yaml"), "");
}

/// The section of workflows/mochikoshi.yaml.
inline flowslide::SectionConfig mochikoshi() {
  const auto document = flowslide::load_yaml(flowslide::test::source("workflows/mochikoshi.yaml"));
  const auto mesh = document.find("stages")->find("mesh")->find("with");
  return flowslide::read_settings<flowslide::SectionConfig>(mesh, "stages.mesh.with");
}

#pragma once
#include "importers/recorder_text.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// What the columns of one recorder mean: [time] then, entity by entity, the named components.
struct ColumnLayout {
  bool time = true;
  std::vector<std::string> components;              ///< of one entity, e.g. xx yy xy
  std::string_view noun;                            ///< "node" or "element"
  const std::vector<std::int64_t>* tags = nullptr;  ///< of the entities, in column order
  std::string mesh_file;                            ///< where the number of entities comes from

  [[nodiscard]] std::size_t offset() const { return time ? 1 : 0; }
  [[nodiscard]] std::size_t width() const { return components.size(); }
  [[nodiscard]] std::size_t columns() const { return offset() + width() * tags->size(); }
};

/// "node 17 y", "time"; columns count from 1.
ColumnLabel column_label(const ColumnLayout& layout);

/// Throws InputError that shows how the number of columns factorises, with and without a time
/// column, and what is the likely cause. `first_column`, as far as it was read, tells a time column
/// from values.
void check_columns(const std::string& file, std::size_t columns, const ColumnLayout& layout,
                   std::span<const double> first_column = {});

/// One component of an entity: the mean over the columns of its name, which must be present().
class Component {
 public:
  Component(const ColumnLayout& layout, std::string_view name);
  [[nodiscard]] bool present() const { return !positions_.empty(); }
  [[nodiscard]] double at(const std::vector<double>& row, std::size_t entity) const;

 private:
  std::size_t offset_;
  std::size_t width_;
  std::vector<std::size_t> positions_;
};

}  // namespace flowslide

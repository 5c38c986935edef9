#pragma once
#include "study/run/store.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flowslide::study {

enum class State {
  waiting,  ///< for stages before it
  ready,
  running,
  done,
  failed,
  blocked,  ///< a stage before it failed
};

/// How far a node is.
struct NodeState {
  State state = State::waiting;
  std::string key;                   ///< known when all before it are done
  std::optional<Finished> finished;  ///< when done
  std::optional<Failure> failure;    ///< when failed
  std::size_t blocker = 0;           ///< when blocked: the node that failed
  bool again = false;                ///< done before, but its files are needed and have gone
};

/// Which failures of earlier sessions are to be tried again.
enum class Retry {
  none,
  passing,  ///< those that need not come again: killed, no memory, another program
  all,
};

/// What a store holds of a plan.
class StudyState {
 public:
  StudyState(const Plan& plan, const Store& store);

  /// Looks the nodes up whose inputs have become known.
  void resolve();
  /// Lets failures be tried again, now and when later nodes are looked up.
  void reopen(Retry retry);
  /// Looks again at a node that is ready: another process may have done it, or failed. Is it
  /// still to be run?
  bool is_open(std::size_t node);
  [[nodiscard]] const std::vector<NodeState>& nodes() const { return nodes_; }
  NodeState& node(std::size_t index) { return nodes_[index]; }
  [[nodiscard]] const NodeState& node(std::size_t index) const { return nodes_[index]; }

  /// Of a row: done when all its stages are.
  [[nodiscard]] State row_state(const Row& row) const;
  /// The node for which a row has failed or is blocked.
  [[nodiscard]] std::optional<std::size_t> failed_node(const Row& row) const;
  /// "flow: error in step 12" with the stage in front; empty for a row that has not failed.
  [[nodiscard]] std::string cause(const Row& row) const;
  [[nodiscard]] std::size_t count(State state) const;

 private:
  [[nodiscard]] std::string key_of(std::size_t node) const;
  const Plan& plan_;
  const Store& store_;
  Retry retry_ = Retry::none;
  std::vector<NodeState> nodes_;
};

}  // namespace flowslide::study

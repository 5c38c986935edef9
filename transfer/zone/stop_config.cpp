#include "transfer/zone/stop_config.hpp"

#include "core/check.hpp"

namespace flowslide {

void check(const StopAtTransferConfig& c) {
  check(static_cast<const TransferRuleConfig&>(c));
  const TransferWhen when = c.transfer.when;
  validate(when == TransferWhen::automatic || when == TransferWhen::at,
           "stop_at_transfer has when: {} (that says nothing about the end of the shaking) write "
           "when: automatic or at, or leave out stop_at_transfer",
           kTransferWhens[static_cast<std::size_t>(when)]);
}

void Schema<StopAtTransferConfig>::describe(FieldVisitor& v, StopAtTransferConfig& c) {
  Schema<TransferRuleConfig>::describe(v, c);
  for (const char* key : {"zone", "line", "polygon", "strength"}) v.passed_over(key);
  v.quantity("after", c.after, Dim::time, {.min = 0.0}, "time recorded beyond that");
}

}  // namespace flowslide

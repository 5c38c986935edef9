#pragma once
/// What a power cut would take: bytes written and not synced since. Only for Action::cut.
namespace faults {

void note_open(int file);
void note_change(int file);
void note_sync(int file);

}  // namespace faults

#pragma once
/// What a power cut would take: bytes written and not synced since, and, with Action::names,
/// renames whose folder was not synced since. For these two actions only.
namespace faults {

void note_open(int file);
void note_sync(int file);
void note_rename(int from_folder, const char* from, int to_folder, const char* to);

}  // namespace faults

#include <filesystem>
#include <fstream>
#include <string>

/// The control of the fault loops: writes as a program should not. Its own reader of errors is
/// faults.py, which has to find every one of its faults.
int main(int count, char** arguments) {
  if (count < 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::ofstream(folder / "unchecked.txt") << std::string(5000, 'x');  // no look at the outcome
  std::ofstream part(folder / "unsynced.partial");
  part << std::string(5000, 'y');
  part.close();
  if (!part) return 4;
  std::error_code ignored;
  std::filesystem::rename(folder / "unsynced.partial", folder / "unsynced.txt", ignored);
  return 0;
}

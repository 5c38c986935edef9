#include "model/checkpoint_file.hpp"

#include "core/check.hpp"

namespace flowslide {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.parent_path().empty() ? "." : path.parent_path();
}

}  // namespace

bool find_checkpoint(const std::filesystem::path& path) {
  remove_leftovers(folder_of(path));
  std::error_code error;
  const auto status = std::filesystem::symlink_status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return false;
  if (error)
    throw FileError(
        fmt::format("the checkpoint '{}' cannot be read ({})", path.string(), error.message()));
  return true;
}

void remove_checkpoint(const std::filesystem::path& path) {
  remove_path(path);
  sync_path(folder_of(path));
}

void refuse_checkpoint(const std::filesystem::path& path, std::string_view why) {
  throw FileError(
      fmt::format("the checkpoint '{}' cannot be continued ({}) delete it to start the stage from "
                  "its beginning",
                  path.string(), why));
}

CheckpointWriter::CheckpointWriter(const std::filesystem::path& path, std::uint64_t fields)
    : out_(path) {
  value(fields);
}

void CheckpointWriter::put(const void* bytes, std::size_t size) {
  out_.write(bytes, size);
  digest_.add(bytes, size);
}

void CheckpointWriter::finish() {
  out_.write(digest_.hex());
  out_.commit();
}

CheckpointReader::CheckpointReader(std::filesystem::path path, std::uint64_t fields)
    : path_(std::move(path)) {
  expect_regular_file(path_);
  in_.open(path_, std::ios::binary);
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path_, error);
  if (error || !in_) fail_to_read();
  if (size < kSha256Digits + sizeof fields) refuse("it is cut off");
  left_ = size - kSha256Digits;

  Sha256 digest;
  std::vector<char> block(std::min<std::uint64_t>(left_, 1 << 20));
  for (std::uint64_t left = left_; left > 0;) {
    const std::uint64_t n = std::min<std::uint64_t>(left, block.size());
    in_.read(block.data(), static_cast<std::streamsize>(n));
    digest.add(block.data(), n);
    left -= n;
  }
  std::string checksum(kSha256Digits, ' ');
  in_.read(checksum.data(), kSha256Digits);
  if (!in_) fail_to_read();
  if (checksum != digest.hex())
    refuse("its checksum does not fit its bytes: it is damaged, cut off, or of an older program");
  in_.seekg(0);
  std::uint64_t found = 0;
  value(found);
  if (found != fields) refuse("it is of another version of the program");
}

void CheckpointReader::take(void* bytes, std::size_t size) {
  if (size > left_) refuse("it ends within a field");
  in_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size));
  if (!in_) fail_to_read();
  left_ -= size;
}

void CheckpointReader::finish() {
  if (left_ > 0) refuse("it has more fields than expected");
}

void CheckpointReader::fail_to_read() const {
  throw FileError(fmt::format("the checkpoint '{}' cannot be read (its disk or its permissions)",
                              path_.string()));
}

}  // namespace flowslide

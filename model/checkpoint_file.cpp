#include "model/checkpoint_file.hpp"

#include "core/check.hpp"

#include <array>

namespace flowslide {
namespace {

constexpr std::size_t kDigits = 64;  ///< of the checksum

}  // namespace

CheckpointWriter::CheckpointWriter(std::filesystem::path path, std::uint64_t fields)
    : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
  out_.open(partial_, std::ios::binary);
  value(fields);
}

void CheckpointWriter::put(const void* bytes, std::size_t size) {
  out_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  digest_.add(bytes, size);
}

void CheckpointWriter::finish() {
  const std::string checksum = digest_.hex();
  out_.write(checksum.data(), kDigits);
  out_.close();
  std::error_code error = std::make_error_code(std::errc::io_error);
  if (!out_.fail()) std::filesystem::rename(partial_, path_, error);
  if (error)
    throw FileError(fmt::format("cannot write the checkpoint '{}' ({}) is the disk full?",
                                path_.string(), error.message()));
}

CheckpointReader::CheckpointReader(std::filesystem::path path, std::uint64_t fields)
    : path_(std::move(path)), in_(path_, std::ios::binary) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path_, error);
  if (error || !in_) refuse("it cannot be read");
  if (size < kDigits + sizeof fields) refuse("it is cut off");
  left_ = size - kDigits;

  Sha256 digest;
  std::vector<char> block(std::min<std::uint64_t>(left_, 1 << 20));
  for (std::uint64_t left = left_; left > 0;) {
    const std::uint64_t n = std::min<std::uint64_t>(left, block.size());
    in_.read(block.data(), static_cast<std::streamsize>(n));
    digest.add(block.data(), n);
    left -= n;
  }
  std::string checksum(kDigits, ' ');
  in_.read(checksum.data(), kDigits);
  if (!in_ || checksum != digest.hex())
    refuse("its checksum does not fit its bytes: it is damaged, cut off, or of an older program");
  in_.seekg(0);
  std::uint64_t found = 0;
  value(found);
  if (found != fields) refuse("it is of another version of the program");
}

void CheckpointReader::take(void* bytes, std::size_t size) {
  if (size > left_) refuse("it ends within a field");
  in_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size));
  if (!in_) refuse("it cannot be read");
  left_ -= size;
}

void CheckpointReader::finish() {
  if (left_ > 0) refuse("it has more fields than expected");
}

void CheckpointReader::refuse(const char* why) const {
  throw FileError(
      fmt::format("the checkpoint '{}' cannot be continued ({}) delete it to start the stage from "
                  "its beginning",
                  path_.string(), why));
}

}  // namespace flowslide

namespace {
constexpr int kTaken = 3, kRight = 4;
}  // namespace

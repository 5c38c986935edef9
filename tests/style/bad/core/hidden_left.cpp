namespace {
constexpr int kLeft = 1, kTaken = 2;
}  // namespace

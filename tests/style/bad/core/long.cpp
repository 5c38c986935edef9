namespace flowslide {
namespace {

int short_one(int a) {
  return a;
}

/// A head of two lines, a lambda and a blank line: seven lines.
template <int N>
int long_one(int a,
             int b) {
  const auto twice = [](int x) {
    return 2 * x;
  };

  return twice(a) + b + N;
}

}  // namespace
}  // namespace flowslide
/// Things that occured.

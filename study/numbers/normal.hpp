#pragma once

/// The standard normal distribution, with the same bits on every machine.
namespace flowslide::study {

/// Probability of a value below x; West (2005) after Hart (1968), to 1e-15.
double normal_probability(double x);

/// The value with the probability p in (0, 1) below it; Wichura (1988), AS 241, to 1e-15.
double normal_quantile(double p);

}  // namespace flowslide::study

#pragma once

namespace sonarsim {

/// The probability that a draw of Student's distribution lies further from 0 than `t`.
double student_tails(double t, double degrees);

/// The two-sided 95 % quantile: 5 % of the draws lie further from 0.
double student_95(double degrees);

}  // namespace sonarsim

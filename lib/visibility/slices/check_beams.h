#pragma once

#include <deque>
#include <span>
#include <vector>

#include "visibility/engine.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/kept_gaps.h"
#include "visibility/slices/swept_frame.h"

namespace sonarsim {

/// True if beams are drawn to be checked. Views of few beams and those with fine goals are checked
/// whole.
bool draws_beams(const View& view);

/// Checks beams that are drawn at random, until the estimate meets the goal or all are checked. It
/// also stops if checks alone cannot meet the goal.
///
/// A few beams are drawn first, then more and more. A beam is drawn twice as often if its slices
/// disagree three times as much as those of the others. The draw is independent of the errors, so
/// the sum of D (BeamCheck) over the drawn beams, each times the number of beams that it stands
/// for, is an unbiased estimate of the sum over all beams that were not checked before, however
/// badly the disagreement predicts D.
void check_drawn(std::deque<SweptFrame>& frames, double goal, BeamErrors& errors);

/// Scans the slices of a view's frames, and checks beams that are drawn.
void sweep_and_draw(const SlicesPing& ping, std::span<const SliceFrame> frames, double goal,
                    SlicesImage& image);

/// Replaces the samples of checked beams by those of their checks. `keeps_compared`: both go to
/// Samples::compared.
void replace_checked(bool keeps_compared, SlicesImage& image);

}  // namespace sonarsim

#include "simulate/labels/silhouette.h"

#include "support/test.h"

namespace {

using Ids = std::vector<std::uint16_t>;

/// A picture as text, a line of it for each line; '.' is no id.
struct DrawnIds {
    MaskFrame frame;
    Ids ids;

    DrawnIds(const std::vector<std::string>& lines, const ResolutionCell& cell = {})
        : frame{static_cast<int>(lines.size()), static_cast<int>(lines[0].size()), cell} {
        for (const std::string& line : lines) {
            for (const char c : line)
                ids.push_back(c == '.' ? 0 : static_cast<std::uint16_t>(c - '0'));
        }
    }
    std::vector<std::string> text(const Ids& of) const {
        std::vector<std::string> lines;
        for (std::size_t k = 0; k < of.size(); ++k) {
            if (k % frame.bins == 0) lines.emplace_back();
            lines.back() += of[k] == 0 ? '.' : static_cast<char>('0' + of[k]);
        }
        return lines;
    }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("silhouette: a piece without visible surface of its object is its mirror image") {
    const DrawnIds drawn({"11.11..", "11.11.2", ".......", "..33...", "..33..."});
    const DrawnIds visible({"1......", "..2....", ".......", "......3", "......."});
    Ids found = drawn.ids;
    drop_mirror_images(drawn.frame, visible.ids, found);
    CHECK(drawn.text(found) == Lines{"11.....", "11.....", ".......", ".......", "......."});
}

TEST_CASE("outline: the body in view is what comes up to a share of all else in a cell") {
    const MaskFrame frame{1, 6, {}};
    const Ids object{1, 1, 1, 2, 2, 0};
    const std::vector<float> echo{1.0F, 1.0F, 1.0F, 8.0F, 1.0F, 0.0F};
    const std::vector<float> whole{1.0F, 4.9F, 5.1F, 9.0F, 1.0F, 7.0F};
    CHECK(find_bodies({frame, object, echo, whole}, {}, 0.25F) == Ids{1, 1, 0, 2, 2, 0});
    const std::vector<float> noise{3.9F, 0.0F, 0.0F, 0.0F, 4.1F, 0.0F};
    CHECK(find_bodies({frame, object, echo, whole}, noise, 0.25F) == Ids{1, 1, 0, 2, 0, 0});
    // In cells of three bins the strong bins of a body carry the weak one between them.
    const std::vector<float> weak{6.0F, 0.1F, 6.0F};
    const std::vector<float> all{7.0F, 5.0F, 7.0F};
    CHECK(find_bodies({{1, 3, {.range_bins = 3.0, .beams = 1.0}}, Ids(3, 1), weak, all}, {},
                      0.25F) == Ids(3, 1));
}

TEST_CASE("outline: what is bright beside a body belongs to it, but for whiskers") {
    const DrawnIds body({".......", ".111...", ".111...", ".......", "......."});
    const DrawnIds bright({"..1....", ".1111.1", ".111...", ".111...", "...2222"});
    Ids bodies = body.ids;
    add_bright(body.frame, bright.ids, bodies);
    CHECK(body.text(bodies) == Lines{".......", ".111...", ".111...", ".111...", "......."});
}

TEST_CASE("outline: half a cell around a body, filled, and one piece for a contiguous body") {
    const DrawnIds drawn(
        {"............", "..1...1.....", "............", "..1...1...2.", "............"},
        {.range_bins = 5.0, .beams = 3.0});
    CHECK(drawn.text(outlined(drawn.frame, drawn.ids)) ==
          Lines{"111111111...", "111111111...", "111111111222", "111111111222", "111111111222"});
    const DrawnIds other({"1111", "1221", "1111"});
    CHECK(other.text(outlined(other.frame, other.ids)) == other.text(other.ids));
}

TEST_CASE("outline: over the seam of a full turn it is that of any other place") {
    DrawnIds drawn({"......", "......", ".1111.", ".11...", ".1111.", "......"}, {3.0, 3.0});
    drawn.frame.full_turn = true;
    Ids expected = outlined(drawn.frame, drawn.ids);
    std::ranges::rotate(expected, expected.begin() + 18);  // three lines
    std::ranges::rotate(drawn.ids, drawn.ids.begin() + 18);
    CHECK(drawn.text(outlined(drawn.frame, drawn.ids)) == drawn.text(expected));
}

TEST_CASE("outline: a compact body is convex, an open one is not, a ring at the border is closed") {
    const DrawnIds notched({"......", ".1111.", ".11...", ".1111.", "......"});
    CHECK(notched.text(outlined(notched.frame, notched.ids)) ==
          Lines{"......", ".1111.", ".1111.", ".1111.", "......"});
    const DrawnIds hook({"..........", ".1........", ".1........", ".1........", ".1........",
                         ".1........", ".11111111.", ".........."});
    CHECK(hook.text(outlined(hook.frame, hook.ids)) == hook.text(hook.ids));
    const DrawnIds cut(
        {".1......1.", ".1......1.", ".1......1.", ".11....11.", "..111111..", ".........."});
    CHECK(cut.text(outlined(cut.frame, cut.ids)) == Lines{".11111111.", ".11111111.", ".11111111.",
                                                          ".11111111.", "..111111..",
                                                          ".........."});
    // A wall from one side of the picture to another.
    const DrawnIds wall({".11.........", ".11.........", ".11.........", ".11.........",
                         ".11.........", ".11.........", ".11111111111", "............"});
    CHECK(wall.text(outlined(wall.frame, wall.ids)) == wall.text(wall.ids));
}

/// The ids of a fan's bins whose middles lie in a bar of the plane, along `angle`, at the depth of
/// 50 bins; `gap`: half the length of a piece that is missing of its far half.
DrawnIds bar_in_fan(const MaskFrame& frame, double angle, double gap) {
    DrawnIds bar(std::vector<std::string>(frame.lines, std::string(frame.bins, '.')));
    bar.frame = frame;
    for (int line = 0; line < frame.lines; ++line) {
        const SinCos a = sincos((line + 0.5 - 0.5 * frame.lines) * frame.beam_rad);
        for (int bin = 0; bin < frame.bins; ++bin) {
            const double range = frame.first_bin + bin + 0.5;
            const SinCos turn = sincos(angle);
            const double x = range * a.sin;
            const double y = range * a.cos - frame.first_bin - 50.0;
            const double along = turn.cos * x + turn.sin * y;
            const double across = turn.cos * y - turn.sin * x;
            const bool inside = std::fabs(along) < 40.0 && std::fabs(across) < 6.0;
            const bool missing = std::fabs(along) < gap && across > 0.0;
            if (inside && !missing) bar.ids[static_cast<std::size_t>(line) * frame.bins + bin] = 1;
        }
    }
    return bar;
}

// Straight in the plane of the picture: across a fan of 60 degrees the range of a bar changes by
// 0.15 of itself, three times its width.
TEST_CASE("outline: a hull is straight in the plane of a fan") {
    const MaskFrame frame{60, 120, {}, radians(1.0), 60.0};
    for (const double angle : {-0.5, 0.0, 0.7}) {
        const DrawnIds whole = bar_in_fan(frame, angle, 0.0);
        const DrawnIds broken = bar_in_fan(frame, angle, 10.0);
        const Ids drawn = outlined(frame, broken.ids);
        int different = 0;
        for (std::size_t k = 0; k < drawn.size(); ++k)
            different += drawn[k] != whole.ids[k] ? 1 : 0;
        CAPTURE(angle);
        CHECK(different < 0.04 * static_cast<double>(std::ranges::count(whole.ids, 1)));
    }
}

TEST_CASE("silhouette: an object has the shadow behind it") {
    const DrawnIds drawn({".......", ".11....", ".11....", "......."});
    const DrawnIds shadow({".......", "...111.", "....112", "....11."});
    const std::vector<std::uint8_t> all_finder(3, 1);
    CHECK(drawn.text(with_shadows(drawn.frame, drawn.ids, shadow.ids, all_finder)) ==
          Lines{".......", ".11111.", ".11111.", "....11."});
    const DrawnIds far({".......", ".......", ".......", ".......", "....111"});
    const DrawnIds object({".11....", ".......", ".......", ".......", "......."});
    CHECK(object.text(with_shadows(object.frame, object.ids, far.ids, all_finder)) ==
          object.text(object.ids));
}

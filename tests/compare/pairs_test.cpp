#include <doctest/doctest.h>

#include "calibrate/made_pings.h"
#include "compare/compare.h"

using namespace sonarsim;

TEST_SUITE("compare") {
    TEST_CASE("compare: 100 pairs of simulated sets that differ by their seed" * doctest::skip()) {
        // A pair is called different with a probability of at most 5 %; 11 or more of 100 are so
        // with a probability of 0.012, the significance of this test.
        const Samples bottom = test::made_bottom(3.0, 5.0);
        int same = 0;
        for (std::uint32_t pair = 0; pair < 100; ++pair) {
            const SonarConfig config = test::drawn_instrument(5000 + pair);
            Recording sets[] = {test::made_recording(config, 6, 2 * pair + 1, bottom),
                                test::made_recording(config, 6, 2 * pair + 2, bottom)};
            for (Recording& set : sets) {
                const ReceiverConfig& receiver = config.instrument.receiver;
                set.law.kind = receiver.companding == Companding::log ? RecordedLaw::Kind::decibel
                                                                      : RecordedLaw::Kind::gamma;
                set.law.exponent = receiver.gamma;
                set.law.range_db = receiver.dynamic_range_db;
                set.law.offset = receiver.offset;
            }
            same += compare_recordings(sets[0], sets[1]).is_same() ? 1 : 0;
        }
        MESSAGE("the same: ", same, " of 100 pairs");
        CHECK(same >= 90);
    }
}

#include "simulate/trace/ping_motion.h"

#include "core/elementary.h"
#include "simulate/trace/sample_kinds.h"

namespace sonarsim {

namespace {

/// The rotation about a vector by its length in radians.
Eigen::Quaterniond rotation_by(const Eigen::Vector3d& turn_rad) {
    const double angle = turn_rad.norm();
    if (!(angle > 0.0)) return Eigen::Quaterniond::Identity();
    const SinCos half = sincos(0.5 * angle);
    const Eigen::Vector3d axis = half.sin / angle * turn_rad;
    return {half.cos, axis.x(), axis.y(), axis.z()};
}

/// True if reception measures the azimuth alone (measured_place()); otherwise the pose half way
/// between transmission and reception measures the direction.
bool measures_azimuth(const PingMotion& motion, ViewShape shape) {
    return shape == ViewShape::fan && motion.measures_direction;
}

/// The moment whose frame measures directions, as a share of the two-way time.
double reception_share(const PingMotion& motion, ViewShape shape) {
    return measures_azimuth(motion, shape) ? 1.0 : 0.5;
}

double elevation_of(const Eigen::Vector3d& v) {
    return arctan2(v.z(), v.head<2>().norm());
}

/// A place in the frame that measures directions; `measured` has the elevation at transmission.
struct MovedPlace {
    Eigen::Quaterniond turn;
    Eigen::Vector3d turned, measured;
};

/// The time of sound to a place and back to the moving sonar: the greater root of |p - v t| = c t -
/// |p|, which is t = 2 (c |p| - v . p) / (c^2 - v^2).
double two_way_time(const PingMotion& motion, const Eigen::Vector3d& place) {
    const double c = motion.sound_speed_m_s;
    const Eigen::Vector3d& v = motion.velocity_m_s;
    return 2.0 * (c * place.norm() - v.dot(place)) / (c * c - v.squaredNorm());
}

MovedPlace moved_place(const PingMotion& motion, ViewShape shape, const Eigen::Vector3d& place) {
    const double time = two_way_time(motion, place);
    const double moving = reception_share(motion, shape) * time;
    const Eigen::Quaterniond turn = rotation_by(moving * motion.turn_rad_s).conjugate();
    const Eigen::Vector3d from_there = turn * (place - moving * motion.velocity_m_s);
    const double range = 0.5 * motion.sound_speed_m_s * time;
    const Eigen::Vector3d turned = range * from_there.normalized();
    if (!measures_azimuth(motion, shape)) return {turn, turned, turned};
    const double azimuth = arctan2(turned.y(), turned.x());
    return {turn, turned, range * direction_of(azimuth, elevation_of(place))};
}

/// A sample as the moving sonar measures it. Its edges are only turned: its parts differ in two-way
/// time by 2 / c for each metre; in this time a sonar moves by millimetres and turns by below 1e-3.
Sample moved(const PingMotion& motion, ViewShape shape, const Sample& sample) {
    const Eigen::Vector3d place = sample.position.cast<double>();
    const MovedPlace there = moved_place(motion, shape, place);
    const Eigen::Matrix3f turn =
        (Eigen::Quaterniond::FromTwoVectors(there.turned, there.measured) * there.turn)
            .toRotationMatrix()
            .cast<float>();
    Sample out = sample;
    out.position = there.measured.cast<float>();
    out.edge_u = turn * sample.edge_u;
    out.edge_v = turn * sample.edge_v;
    out.normal = turn * sample.normal;
    out.height_m *= static_cast<float>(there.measured.norm() / place.norm());
    return out;
}

/// The place that is `measured` in the frame that measures directions.
Eigen::Vector3d unturned_place(const PingMotion& motion, ViewShape shape,
                               const Eigen::Vector3d& measured) {
    // The place is s + l d, with s the sonar's motion meanwhile and d the direction in the frame at
    // transmission. Its two-way time must be that of the measured range. Newton's steps in l use
    // the derivative 2 / c of a sonar at rest. Its relative error is the ratio of the speeds of
    // sonar and sound, so each step reduces the error of l about a thousandfold.
    double length = measured.norm();
    const double time = 2.0 * length / motion.sound_speed_m_s;
    const double moving = reception_share(motion, shape) * time;
    const Eigen::Vector3d d = rotation_by(moving * motion.turn_rad_s) * measured.normalized();
    const Eigen::Vector3d s = moving * motion.velocity_m_s;
    for (int k = 0; k < 4; ++k)
        length += 0.5 * motion.sound_speed_m_s * (time - two_way_time(motion, s + length * d));
    return s + length * d;
}

/// The azimuth of a point, in beams from the first border of a fan.
double beams_from_border(const View& view, const Eigen::Vector3f& p) {
    const double azimuth = arctan2(static_cast<double>(p.y()), static_cast<double>(p.x()));
    return (azimuth / view.azimuth_rad + 0.5) * view.beams;
}

/// The part of a footprint from `low` to `high` along edge_u, which extends from -1 to 1.
Sample part_of(const Sample& sample, double low, double high) {
    const auto middle = static_cast<float>(0.5 * (low + high));
    const auto share = static_cast<float>(0.5 * (high - low));
    const float longer = 1.0F + sample.wedge * middle;  // edge_v, over its mean
    Sample part = sample;
    part.edge_u *= share;
    part.edge_v *= longer;
    part.area_m2 *= share * longer;
    part.wedge *= share / longer;
    part.position = sample.middle() + middle * sample.edge_u + part.wedge / 3.0F * part.edge_u;
    return part;
}

/// Calls `add(beam, part)` for the parts of a footprint between the borders of a fan's beams, by
/// azimuth alone. Engines trace columns within a beam, which the motion turns across its borders:
/// as a whole, a column would give its beam the ranges of a direction up to half a beam off.
/// Where energies add, a footprint may cover many beams and is not cut.
template <class Add>
void for_each_beam(const View& view, const Sample& sample, Add add) {
    constexpr double sliver = 0.1;  // in beams, as far as footprints may extend into another one
    const Eigen::Vector3f& p = sample.position;
    const double place = beams_from_border(view, p);
    const float level2 = p.head<2>().squaredNorm();
    const float across2 = p.x() * sample.edge_u.y() - p.y() * sample.edge_u.x();
    const double along_u = level2 > 0.0F ? across2 / level2 * view.beams / view.azimuth_rad : 0.0;
    // Straight above the sonar a footprint spans all azimuths.
    const double half = std::min(std::fabs(along_u), 0.5 * view.beams);
    const auto beam_at = [](double at) { return static_cast<int>(std::floor(at)); };
    const int first = beam_at(place - half + sliver);
    const int last = beam_at(place + half - sliver);
    if (view.energies_add || last <= first) return add(beam_at(place), sample);
    for (int beam = first; beam <= last; ++beam) {
        const double low = beam > first ? (beam - place) / along_u : std::copysign(1.0, -along_u);
        const double high =
            beam < last ? (beam + 1 - place) / along_u : std::copysign(1.0, along_u);
        add(beam, part_of(sample, std::min(low, high), std::max(low, high)));
    }
}

/// Sorts the visible surface of a fan into the beams of its azimuths.
void sort_into_beams(const View& view, Samples& samples) {
    if (view.shape != ViewShape::fan) return;
    std::vector<std::vector<Sample>> beam_samples(view.beams);
    std::vector<Sample> outside;
    const bool full_turn = is_full_turn(view);
    for (const Sample& sample : samples.items) {
        if (!kind_of(sample.kind).hides) {
            outside.push_back(sample);
            continue;
        }
        for_each_beam(view, sample, [&](int beam, const Sample& part) {
            if (full_turn) beam = (beam + view.beams) % view.beams;
            const bool in_view = beam >= 0 && beam < view.beams;
            (in_view ? beam_samples[beam] : outside).push_back(part);
        });
    }
    samples.items.clear();
    for (int j = 0; j < view.beams; ++j) {
        samples.items.insert(samples.items.end(), beam_samples[j].begin(), beam_samples[j].end());
        samples.beam_begin[j + 1] = static_cast<std::uint32_t>(samples.items.size());
    }
    samples.items.insert(samples.items.end(), outside.begin(), outside.end());
}

}  // namespace

PingMotion motion_after(const PingMotion& motion, double later_s) {
    PingMotion out = motion;
    out.velocity_m_s = rotation_by(later_s * motion.turn_rad_s).conjugate() * motion.velocity_m_s;
    return out;
}

Pose pose_after(const PingMotion& motion, const Pose& T_world_sensor, double later_s) {
    if (motion.is_still()) return T_world_sensor;
    return T_world_sensor *
           Pose{rotation_by(later_s * motion.turn_rad_s), later_s * motion.velocity_m_s};
}

Eigen::Vector3d measured_place(const PingMotion& motion, ViewShape shape,
                               const Eigen::Vector3d& place) {
    return moved_place(motion, shape, place).measured;
}

Eigen::Vector3d unmoved_place(const PingMotion& motion, ViewShape shape,
                              const Eigen::Vector3d& measured) {
    if (!measures_azimuth(motion, shape)) return unturned_place(motion, shape, measured);
    const double range = measured.norm();
    const double azimuth = arctan2(measured.y(), measured.x());
    double elevation = elevation_of(measured);  // at reception
    Eigen::Vector3d place;
    for (int k = 0; k < 6; ++k) {  // each step reduces the error about a hundredfold
        place = unturned_place(motion, shape, range * direction_of(azimuth, elevation));
        elevation += elevation_of(measured) - elevation_of(place);
    }
    return place;
}

void move_in_ping(const PingMotion& motion, const View& view, Samples& samples) {
    if (motion.is_still()) return;
    for (Sample& sample : samples.items)
        sample = moved(motion, view.shape, sample);
    sort_into_beams(view, samples);
}

}  // namespace sonarsim

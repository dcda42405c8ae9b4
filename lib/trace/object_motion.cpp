#include "trace/object_motion.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

/// The place with the range shift of a pulse that sweeps.
Eigen::Vector3d shifted(const PingMotion& sonar, const Eigen::Vector3d& place,
                        const Eigen::Vector3d& velocity) {
    const Eigen::Vector3d direction = place.normalized();
    return place + sonar.doppler_s * velocity.dot(direction) * direction;
}

/// The motions of a ping in the frame of its sonar.
class ObjectMover {
  public:
    ObjectMover(const MovingObjects& moving, const PingMotion& sonar, const Pose& T_world_sensor)
        : moving_(moving), sonar_(sonar), T_world_sensor_(T_world_sensor) {}

    /// Null if the instance stands still.
    const ObjectMotion* motion_of(std::uint32_t instance) const {
        const auto found = std::ranges::find(moving_.all, instance, &ObjectMotion::instance);
        return found == moving_.all.end() ? nullptr : &*found;
    }

    struct Moved {
        Eigen::Vector3d place;
        Eigen::Matrix3d turn;  ///< turns directions from the ping's time to the moment of meeting
    };
    Moved moved(const ObjectMotion& motion, const Eigen::Vector3d& place) const {
        const Eigen::Quaterniond to_sensor = T_world_sensor_.rotation.conjugate();
        const Eigen::Vector3d world =
            T_world_sensor_.rotation * place + T_world_sensor_.translation;
        const Eigen::Vector3d arm = world - motion.centre_m;
        const auto at = [&](double time_s) -> Eigen::Vector3d {
            return motion.centre_m + time_s * motion.velocity_m_s +
                   rotation_by(time_s * motion.turn_rad_s) * arm;
        };
        const Eigen::Vector3d later_arm = rotation_by(moving_.later_s * motion.turn_rad_s) * arm;
        const Eigen::Vector3d velocity =
            to_sensor * (motion.velocity_m_s + motion.turn_rad_s.cross(later_arm));
        const Eigen::Vector3d later =
            to_sensor * (at(moving_.later_s) - T_world_sensor_.translation);
        const double time = moving_.later_s + meeting_time(sonar_.sound_speed_m_s, later, velocity);
        const Eigen::Vector3d met = to_sensor * (at(time) - T_world_sensor_.translation);
        const Eigen::Quaterniond turn =
            to_sensor * rotation_by(time * motion.turn_rad_s) * T_world_sensor_.rotation;
        return {shifted(sonar_, met, velocity), turn.toRotationMatrix()};
    }

    /// The speed at which a place recedes from the sonar. `motion` is null if the place stands
    /// still.
    double recedes_m_s(const ObjectMotion* motion, const Eigen::Vector3d& place) const {
        Eigen::Vector3d velocity = -sonar_.velocity_m_s;
        if (motion != nullptr) {
            const Eigen::Vector3d world =
                T_world_sensor_.rotation * place + T_world_sensor_.translation;
            const Eigen::Vector3d arm =
                world - motion->centre_m - moving_.later_s * motion->velocity_m_s;
            velocity += T_world_sensor_.rotation.conjugate() *
                        (motion->velocity_m_s + motion->turn_rad_s.cross(arm));
        }
        return velocity.dot(place.normalized());
    }

  private:
    MovingObjects moving_;
    const PingMotion& sonar_;
    const Pose& T_world_sensor_;
};

}  // namespace

double meeting_time(double sound_speed_m_s, const Eigen::Vector3d& place,
                    const Eigen::Vector3d& velocity_m_s) {
    // The greater root of |p + u t| = c t.
    const double c2_u2 = sound_speed_m_s * sound_speed_m_s - velocity_m_s.squaredNorm();
    const double along = place.dot(velocity_m_s);
    return (along + std::sqrt(along * along + c2_u2 * place.squaredNorm())) / c2_u2;
}

Eigen::Vector3d met_place(const PingMotion& sonar, const Eigen::Vector3d& place,
                          const Eigen::Vector3d& velocity_m_s) {
    const Eigen::Vector3d met =
        place + meeting_time(sonar.sound_speed_m_s, place, velocity_m_s) * velocity_m_s;
    return shifted(sonar, met, velocity_m_s);
}

void move_objects(const MovingObjects& moving, const PingMotion& sonar, const Pose& T_world_sensor,
                  std::span<Sample> samples) {
    const ObjectMover mover(moving, sonar, T_world_sensor);
    for (Sample& sample : samples) {
        const ObjectMotion* const motion = mover.motion_of(sample.instance);
        if (motion == nullptr) continue;
        const auto [place, turn] = mover.moved(*motion, sample.position.cast<double>());
        const Eigen::Matrix3f turn_f = turn.cast<float>();
        sample.position = place.cast<float>();
        sample.edge_u = turn_f * sample.edge_u;
        sample.edge_v = turn_f * sample.edge_v;
        sample.normal = turn_f * sample.normal;
        sample.height_m = std::max(-sample.normal.dot(sample.position), 0.0F);
    }
}

void move_objects(const MovingObjects& moving, const PingMotion& sonar, const Pose& T_world_sensor,
                  std::span<TargetFacet> facets) {
    const ObjectMover mover(moving, sonar, T_world_sensor);
    for (TargetFacet& facet : facets) {
        const ObjectMotion* const motion = mover.motion_of(facet.instance);
        if (motion == nullptr) continue;
        for (int k = 0; k < 3; ++k) {
            const auto [place, turn] = mover.moved(*motion, facet.corners[k].cast<double>());
            const Eigen::Matrix3f turn_f = turn.cast<float>();
            facet.corners[k] = place.cast<float>();
            facet.normals[k] = turn_f * facet.normals[k];
            if (k == 0) facet.normal = turn_f * facet.normal;
        }
    }
}

void fade_by_doppler(const MovingObjects& moving, const PingMotion& sonar,
                     const Pose& T_world_sensor, std::span<Sample> samples) {
    if (sonar.loss.is_none()) return;
    const ObjectMover mover(moving, sonar, T_world_sensor);
    for (Sample& sample : samples) {
        const double recedes =
            mover.recedes_m_s(mover.motion_of(sample.instance), sample.position.cast<double>());
        sample.strength *= static_cast<float>(passed_by_filter(sonar.loss, recedes));
    }
}

void fade_by_doppler(const MovingObjects& moving, const PingMotion& sonar,
                     const Pose& T_world_sensor, std::span<TargetFacet> facets) {
    if (sonar.loss.is_none()) return;
    const ObjectMover mover(moving, sonar, T_world_sensor);
    for (TargetFacet& facet : facets) {
        const double recedes =
            mover.recedes_m_s(mover.motion_of(facet.instance), facet.corners[0].cast<double>());
        facet.strength *= static_cast<float>(passed_by_filter(sonar.loss, recedes));
    }
}

}  // namespace sonarsim

#include "trajectory/files.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/file.h"
#include "core/units.h"

using namespace sonarsim;

namespace {

const std::string quaternion_header = "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n";
const std::string angle_header = "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n";

std::string csv_error(const std::string& text) {
    try {
        parse_csv_trajectory(text, "p.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string tum_error(const std::string& text) {
    try {
        parse_tum(text, "p.tum");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

void check_same(const Trajectory& a, const Trajectory& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        CAPTURE(i);
        CHECK(a[i].t_s == b[i].t_s);
        CHECK(a[i].T_world_vehicle.translation == b[i].T_world_vehicle.translation);
        CHECK(a[i].T_world_vehicle.rotation.coeffs() == b[i].T_world_vehicle.rotation.coeffs());
    }
}

}  // namespace

TEST_SUITE("trajectory") {
    TEST_CASE("CSV with quaternions, columns in any order") {
        const Trajectory poses = parse_csv_trajectory(
            "qw,t_s,z_m,y_m,x_m,qx,qy,qz\n"
            "1,0,3,2,1,0,0,0\n"
            "0.5,0.25,6,5,4,-0.5,0.5,0.5\n",
            "p.csv");
        REQUIRE(poses.size() == 2);
        CHECK(poses[1].t_s == 0.25);
        CHECK(poses[1].T_world_vehicle.translation == Eigen::Vector3d(4, 5, 6));
        // Eigen stores x, y, z, w.
        CHECK(poses[1].T_world_vehicle.rotation.coeffs() == Eigen::Vector4d(-0.5, 0.5, 0.5, 0.5));
    }

    TEST_CASE("CSV with angles follows rotation_from_rpy") {
        const Trajectory poses =
            parse_csv_trajectory(angle_header + "0,0,0,0,10,-20,30\n", "p.csv");
        const Eigen::Quaterniond expected =
            rotation_from_rpy(radians(10), radians(-20), radians(30));
        CHECK(poses.at(0).T_world_vehicle.rotation.coeffs() == expected.coeffs());
    }

    TEST_CASE("CSV headers: unknown, double, missing and contradicting columns") {
        const std::string expected =
            "; expected t_s, x_m, y_m, z_m and either qx, qy, qz, qw or roll_deg, pitch_deg, "
            "yaw_deg";
        CHECK(csv_error("t_s,x_m,y_m,z_m,roll_deg,pich_deg,yaw_deg\n") ==
              "p.csv:1: unknown column 'pich_deg' (did you mean 'pitch_deg'?)" + expected);
        CHECK(csv_error("t_s,x_m,y_m,z_m,qx,qy,qz,qw,salinity\n") ==
              "p.csv:1: unknown column 'salinity'" + expected);
        CHECK(csv_error("# survey 7\nt_s,x_m,y_m,x_m\n") == "p.csv:2: column 'x_m' occurs twice");
        CHECK(csv_error("t_s,y_m,qx,qy,qz\n") == "p.csv:1: missing column x_m, z_m, qw" + expected);
        CHECK(csv_error("t_s,x_m,y_m,z_m,yaw_deg\n") ==
              "p.csv:1: missing column roll_deg, pitch_deg" + expected);
        CHECK(csv_error("t_s,x_m,y_m,z_m\n") == "p.csv:1: no attitude" + expected);
        CHECK(csv_error("t_s,x_m,y_m,z_m,qx,qy,qz,qw,yaw_deg\n") ==
              "p.csv:1: two attitudes" + expected);
    }

    TEST_CASE("CSV rows: numbers that are none, not finite or absurd") {
        CHECK(csv_error(angle_header + "0,0,0,0,0,0,0\n1,0,zero,0,0,0,0\n") ==
              "p.csv:3: y_m: 'zero' is not a number");
        CHECK(csv_error(angle_header + "0,nan,0,0,0,0,0\n") ==
              "p.csv:2: x_m: 'nan' is not a finite number");
        // A frequent mistake: nanoseconds since 1970 in the column of seconds.
        CHECK(csv_error(angle_header + "1700000000000000000,0,0,0,0,0,0\n") ==
              "p.csv:2: t_s: '1700000000000000000' is beyond 1e+12; the column's name gives the "
              "unit");
        CHECK(csv_error(angle_header + "0,1e8,-1e8,0,0,0,0\n") == "no error");
        CHECK(csv_error(angle_header + "0,0,0,0,0,0\n") ==
              "p.csv:2: 6 fields, but the header in line 1 has 7");
        // A long or binary field is shown shortened and as plain text.
        CHECK(csv_error(angle_header + "0,0,0,0,0,0," + std::string(100, '9') + "x\n") ==
              "p.csv:2: yaw_deg: '" + std::string(40, '9') + "...' is not a number");
        CHECK(csv_error(angle_header + "0,0,0,0,0,0,1\x1b[2J\n") ==
              "p.csv:2: yaw_deg: '1?[2J' is not a number");
    }

    TEST_CASE("Quaternions: zero and far from unit are errors, nearly unit ones are normalised") {
        CHECK(csv_error(quaternion_header + "0,0,0,0,0,0,0,0\n") ==
              "p.csv:2: the quaternion is zero; a rotation has norm 1");
        CHECK(csv_error(quaternion_header + "0,0,0,0,0,0,0,2\n") ==
              "p.csv:2: the quaternion has norm 2; a rotation has norm 1 (1e-3 off is tolerated)");
        for (const char* qw : {"1.0009", "0.9991"}) {
            const auto poses =
                parse_csv_trajectory(quaternion_header + "0,0,0,0,0,0,0," + qw + "\n", "p.csv");
            CHECK(poses.at(0).T_world_vehicle.rotation.w() == 1.0);
        }
    }

    TEST_CASE("Times must increase strictly, and there must be a pose") {
        CHECK(csv_error(angle_header + "1,0,0,0,0,0,0\n1,0,0,0,0,0,0\n") ==
              "p.csv:3: time 1 s does not come after the 1 s of the pose before; times must "
              "increase strictly");
        CHECK(tum_error("1 0 0 0 0 0 0 1\n\n0.5 0 0 0 0 0 0 1\n") ==
              "p.tum:3: time 0.5 s does not come after the 1 s of the pose before; times must "
              "increase strictly");
        CHECK(csv_error(angle_header) == "p.csv: holds no pose; at least one is needed");
        CHECK(tum_error("# nothing\n\n") == "p.tum: holds no pose; at least one is needed");
        CHECK(tum_error("") == "p.tum: holds no pose; at least one is needed");
    }

    TEST_CASE("TUM: blanks, tabs, CRLF, comments and a missing last newline") {
        const Trajectory poses = parse_tum(
            "# timestamp tx ty tz qx qy qz qw\r\n"
            "  0 1 2 3 0 0 0 1\r\n"
            "\r\n"
            "0.5\t4\t5  6 0.5 0.5 0.5 -0.5 # turning",
            "p.tum");
        REQUIRE(poses.size() == 2);
        CHECK(poses[0].T_world_vehicle.translation == Eigen::Vector3d(1, 2, 3));
        CHECK(poses[1].t_s == 0.5);
        CHECK(poses[1].T_world_vehicle.rotation.coeffs() == Eigen::Vector4d(0.5, 0.5, 0.5, -0.5));
    }

    TEST_CASE("TUM: errors carry line and column") {
        CHECK(tum_error("0 1 2 3 0 0 0\n") ==
              "p.tum:1: 7 fields; a pose has 8: t x y z qx qy qz qw");
        CHECK(tum_error("0 1 2 3 0 0 0 1 9\n") ==
              "p.tum:1: 9 fields; a pose has 8: t x y z qx qy qz qw");
        CHECK(tum_error("# c\n0 1  2,5 3 0 0 0 1\n") == "p.tum:2:6: y_m: '2,5' is not a number");
        CHECK(tum_error("0 1 2 3 0 0 0 nan\n") == "p.tum:1:15: qw: 'nan' is not a finite number");
        CHECK(tum_error("0 1 2 3 0 0 0 0\n") ==
              "p.tum:1: the quaternion is zero; a rotation has norm 1");
    }

    TEST_CASE("What write_tum writes reads back bit for bit") {
        Trajectory poses;
        for (int i = 0; i < 1000; ++i) {
            const double s = i;
            // Thirds and sevenths have no short decimals; the coordinates are UTM-sized, the times
            // epochs.
            poses.push_back({1.7e9 + s / 3.0,
                             {rotation_from_rpy(s / 7.0, s / 11.0, -s / 13.0),
                              {5e6 + s / 7.0, -s / 3.0, 1e-9 * s}}});
        }
        poses.push_back({1.8e9, {Eigen::Quaterniond(-1, -0.0, 0, 0), {-0.0, 1e-300, 0.1}}});
        const std::string text = write_tum(poses);
        check_same(parse_tum(text, "p.tum"), poses);
        check_same(parse_tum("\xEF\xBB\xBF" + text, "p.tum"), poses);  // a byte order mark
        CHECK(write_tum(parse_tum(text, "p.tum")) == text);
        CHECK(write_tum({{0.5, Pose{}}}) == "# t_s x_m y_m z_m qx qy qz qw\n0.5 0 0 0 0 0 0 1\n");
    }

    TEST_CASE("Times far from zero survive the round trip") {
        for (const double begin : {1.7e9, 1e10, 1e11 + 1.0 / 3.0, 1e12 - 10.0, -1.7e9, -1e12}) {
            const std::vector<TimedPose> poses{{begin, {}}, {begin + 0.1, {}}, {begin + 7.0, {}}};
            check_same(parse_tum(write_tum(poses), "p.tum"), poses);
        }
    }

    TEST_CASE("The name of the file says what it is") {
        const auto folder = std::filesystem::temp_directory_path();
        const std::string stem = "sonarsim_trajectory_" + std::to_string(::getpid());
        const std::string csv = angle_header + "0,1,2,3,0,0,0\n";
        const std::string tum = "0 1 2 3 0 0 0 1\n";
        for (const auto& [extension, text] :
             {std::pair{".csv", csv}, {".CSV", csv}, {".txt", tum}, {".tum", tum}}) {
            const auto path = folder / (stem + extension);
            write_file(path, text);
            CHECK(read_trajectory(path).at(0).T_world_vehicle.translation ==
                  Eigen::Vector3d(1, 2, 3));
            std::filesystem::remove(path);
        }
        CHECK_THROWS_WITH_AS(
            read_trajectory("path.json"),
            "path.json: a trajectory's name ends in .csv, or in .txt or .tum for TUM poses",
            InputError);
        CHECK_THROWS_WITH_AS(
            read_trajectory("no/such.csv"),
            "no/such.csv: cannot open: No such file or directory; there is no folder no",
            InputError);
    }
}

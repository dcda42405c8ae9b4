#include "input/trajectory/trajectory.h"
#include "support/test.h"

namespace {

const std::string quaternion_header = "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n";
const std::string angle_header = "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n";

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

TEST_CASE("CSV: quaternions in any order of columns, and angles as of rotation_from_rpy") {
    const Trajectory poses = parse_csv_trajectory(
        "qw,t_s,z_m,y_m,x_m,qx,qy,qz\n1,0,3,2,1,0,0,0\n0.5,0.25,6,5,4,-0.5,0.5,0.5\n", "p.csv");
    REQUIRE(poses.size() == 2);
    CHECK(poses[1].t_s == 0.25);
    CHECK(poses[1].T_world_vehicle.translation == Eigen::Vector3d(4, 5, 6));
    // Eigen stores x, y, z, w.
    CHECK(poses[1].T_world_vehicle.rotation.coeffs() == Eigen::Vector4d(-0.5, 0.5, 0.5, 0.5));
    for (const char* qw : {"1.0009", "0.9991"}) {
        const Trajectory near =
            parse_csv_trajectory(quaternion_header + "0,0,0,0,0,0,0," + qw + "\n", "p.csv");
        CHECK(near.at(0).T_world_vehicle.rotation.w() == 1.0);
    }
    const Trajectory turned =
        parse_csv_trajectory(angle_header + "0,1e8,-1e8,0,10,-20,30\n", "p.csv");
    CHECK(turned.at(0).T_world_vehicle.rotation.coeffs() ==
          rotation_from_rpy(radians(10), radians(-20), radians(30)).coeffs());
}

TEST_CASE("CSV: what is refused, with the line") {
    const std::string expected =
        "; expected t_s, x_m, y_m, z_m and either qx, qy, qz, qw or roll_deg, pitch_deg, "
        "yaw_deg";
    const std::pair<std::string, std::string> faulty[] = {
        {"t_s,x_m,y_m,z_m,roll_deg,pich_deg,yaw_deg\n",
         ":1: unknown column 'pich_deg' (did you mean 'pitch_deg'?)" + expected},
        {"t_s,x_m,y_m,z_m,qx,qy,qz,qw,salinity\n", ":1: unknown column 'salinity'" + expected},
        {"# survey 7\nt_s,x_m,y_m,x_m\n", ":2: column 'x_m' occurs twice"},
        {"t_s,y_m,qx,qy,qz\n", ":1: missing column x_m, z_m, qw" + expected},
        {"t_s,x_m,y_m,z_m,yaw_deg\n", ":1: missing column roll_deg, pitch_deg" + expected},
        {"t_s,x_m,y_m,z_m\n", ":1: no attitude" + expected},
        {"t_s,x_m,y_m,z_m,qx,qy,qz,qw,yaw_deg\n", ":1: two attitudes" + expected},
        {angle_header + "0,0,0,0,0,0,0\n1,0,zero,0,0,0,0\n", ":3: y_m: 'zero' is not a number"},
        {angle_header + "0,nan,0,0,0,0,0\n", ":2: x_m: 'nan' is not a finite number"},
        // A frequent mistake: nanoseconds since 1970 in the column of seconds.
        {angle_header + "1700000000000000000,0,0,0,0,0,0\n",
         ":2: t_s: '1700000000000000000' is beyond 1e+12; the column's name gives the unit"},
        // A long or binary field is shown shortened and as plain text.
        {angle_header + "0,0,0,0,0,0," + std::string(100, '9') + "x\n",
         ":2: yaw_deg: '" + std::string(40, '9') + "...' is not a number"},
        {angle_header + "0,0,0,0,0,0,1\x1b[2J\n", ":2: yaw_deg: '1?[2J' is not a number"},
        {quaternion_header + "0,0,0,0,0,0,0,0\n",
         ":2: the quaternion is zero; a rotation has norm 1"},
        {quaternion_header + "0,0,0,0,0,0,0,2\n",
         ":2: the quaternion has norm 2; a rotation has norm 1 (1e-3 off is tolerated)"},
        {angle_header + "1,0,0,0,0,0,0\n1,0,0,0,0,0,0\n",
         ":3: time 1 s does not come after the 1 s of the pose before; times must increase "
         "strictly"},
        {angle_header, ": holds no pose; at least one is needed"}};
    check_faults(faulty, "p.csv",
                 [](const std::string& text) { parse_csv_trajectory(text, "p.csv"); });
}

TEST_CASE("TUM: blanks, tabs, CRLF, comments and a missing last newline") {
    const Trajectory poses = parse_tum(
        "# timestamp tx ty tz qx qy qz qw\r\n  0 1 2 3 0 0 0 1\r\n\r\n"
        "0.5\t4\t5  6 0.5 0.5 0.5 -0.5 # turning",
        "p.tum");
    REQUIRE(poses.size() == 2);
    CHECK(poses[0].T_world_vehicle.translation == Eigen::Vector3d(1, 2, 3));
    CHECK(poses[1].t_s == 0.5);
    CHECK(poses[1].T_world_vehicle.rotation.coeffs() == Eigen::Vector4d(0.5, 0.5, 0.5, -0.5));
}

TEST_CASE("TUM: what is refused, with line and column") {
    const std::pair<std::string, std::string> faulty[] = {
        {"0 1 2 3 0 0 0\n", ":1: 7 fields; a pose has 8: t x y z qx qy qz qw"},
        {"0 1 2 3 0 0 0 1 9\n", ":1: 9 fields; a pose has 8: t x y z qx qy qz qw"},
        {"# c\n0 1  2,5 3 0 0 0 1\n", ":2:6: y_m: '2,5' is not a number"},
        {"0 1 2 3 0 0 0 nan\n", ":1:15: qw: 'nan' is not a finite number"},
        {"0 1 2 3 0 0 0 0\n", ":1: the quaternion is zero; a rotation has norm 1"},
        {"1 0 0 0 0 0 0 1\n\n0.5 0 0 0 0 0 0 1\n",
         ":3: time 0.5 s does not come after the 1 s of the pose before; times must increase "
         "strictly"},
        {"# nothing\n\n", ": holds no pose; at least one is needed"}};
    check_faults(faulty, "p.tum", [](const std::string& text) { parse_tum(text, "p.tum"); });
}

TEST_CASE("What write_tum writes reads back bit for bit, whatever the times") {
    Trajectory poses;
    for (int i = 0; i < 1000; ++i) {
        const double s = i;
        // Thirds and sevenths have no short decimals; coordinates are UTM-sized, times epochs.
        poses.push_back({1.7e9 + s / 3.0,
                         {rotation_from_rpy(s / 7.0, s / 11.0, -s / 13.0),
                          {5e6 + s / 7.0, -s / 3.0, 1e-9 * s}}});
    }
    poses.push_back({1.8e9, {Eigen::Quaterniond(-1, -0.0, 0, 0), {-0.0, 1e-300, 0.1}}});
    const std::string text = write_tum(poses);
    check_same(parse_tum(text, "p.tum"), poses);
    check_same(parse_tum("\xEF\xBB\xBF" + text, "p.tum"), poses);  // a byte order mark
    CHECK(write_tum({{0.5, Pose{}}}) == "# t_s x_m y_m z_m qx qy qz qw\n0.5 0 0 0 0 0 0 1\n");
    for (const double begin : {1e10, 1e11 + 1.0 / 3.0, 1e12 - 10.0, -1.7e9, -1e12}) {
        const Trajectory far{{begin, {}}, {begin + 0.1, {}}, {begin + 7.0, {}}};
        check_same(parse_tum(write_tum(far), "p.tum"), far);
    }
}

TEST_CASE("The name of the file says what it is") {
    const TemporaryFolder folder;
    const std::string csv = angle_header + "0,1,2,3,0,0,0\n";
    const std::string tum = "0 1 2 3 0 0 0 1\n";
    for (const auto& [name, text] :
         {std::pair{"a.csv", csv}, {"a.CSV", csv}, {"a.txt", tum}, {"a.tum", tum}}) {
        write_file(folder.path / name, text);
        CHECK(read_trajectory(folder.path / name).at(0).T_world_vehicle.translation ==
              Eigen::Vector3d(1, 2, 3));
    }
    CHECK_THROWS_WITH_AS(
        read_trajectory("path.json"),
        "path.json: a trajectory's name ends in .csv, or in .txt or .tum for TUM poses",
        InputError);
}

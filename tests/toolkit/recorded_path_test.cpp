// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/recorded_path.hpp"

#include "cortex/core/error.hpp"

#include "core/model_folder.hpp"
#include "toolkit/allocation_counter.hpp"

#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit {
namespace {

const std::string Header = "time,x,y,z,qx,qy,qz,qw,trigger\n";

std::string path(const std::string& rows) { return "# a comment\n" + Header + rows; }

RecordedPath parsed(const std::string& rows, PathEnd end = PathEnd::Hold) {
    return RecordedPath::parse(path(rows), "hand.csv", end);
}

std::string refusal(const std::string& text, PathEnd end = PathEnd::Hold) {
    try {
        RecordedPath::parse(text, "hand.csv", end);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

void expectRefused(const std::string& rows, const std::vector<std::string>& parts) {
    const std::string message = refusal(path(rows));
    for (const std::string& part : parts) {
        EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
    }
}

// Four samples: along x, turning about z by 0.1 rad each, the trigger pressed in the middle.
std::string fourRows() {
    std::string rows;
    for (int i = 0; i < 4; ++i) {
        rows += std::to_string(0.5 * i) + "," + std::to_string(0.1 * i * i) + ",0.2,0.3,0,0," +
                std::to_string(std::sin(0.05 * i)) + "," + std::to_string(std::cos(0.05 * i)) +
                "," + (i == 1 || i == 2 ? "1" : "0") + "\n";
    }
    return rows;
}

double turnAboutZ(const PathSample& sample) {
    return 2 * std::atan2(sample.pose.rotation.z(), sample.pose.rotation.w());
}

TEST(RecordedPath, PassesThroughItsSamples) {
    const RecordedPath hand = parsed(fourRows());

    EXPECT_DOUBLE_EQ(hand.duration(), 1.5);
    for (int i = 0; i < 4; ++i) {
        const PathSample sample = hand.at(0.5 * i);
        EXPECT_NEAR(sample.pose.position.x(), 0.1 * i * i, 1e-9);
        EXPECT_NEAR(sample.pose.position.y(), 0.2, 1e-9);
        EXPECT_NEAR(sample.pose.position.z(), 0.3, 1e-9);
        EXPECT_NEAR(turnAboutZ(sample), 0.1 * i, 1e-5);
        EXPECT_NEAR(sample.pose.rotation.norm(), 1, 1e-12);
    }
}

TEST(RecordedPath, KeepsSpeedAndTurningSpeedContinuousAcrossSamples) {
    const RecordedPath hand = parsed(fourRows());
    const double h = 1e-6;
    for (const double knot : {0.5, 1.0}) {
        const PathSample before = hand.at(knot - h);
        const PathSample here = hand.at(knot);
        const PathSample after = hand.at(knot + h);

        EXPECT_NEAR((here.pose.position.x() - before.pose.position.x()) / h,
                    (after.pose.position.x() - here.pose.position.x()) / h, 1e-4);
        EXPECT_NEAR((turnAboutZ(here) - turnAboutZ(before)) / h,
                    (turnAboutZ(after) - turnAboutZ(here)) / h, 1e-4);
    }
    EXPECT_NEAR(hand.at(1.0 + h).pose.position.x() - hand.at(1.0).pose.position.x(), 0.8 * h, 1e-9);
}

TEST(RecordedPath, BeginsAndEndsAtRest) {
    const RecordedPath hand = parsed(fourRows());
    const double h = 1e-6;

    EXPECT_NEAR((hand.at(h).pose.position - hand.at(0).pose.position).norm() / h, 0, 1e-4);
    EXPECT_NEAR((hand.at(1.5).pose.position - hand.at(1.5 - h).pose.position).norm() / h, 0, 1e-4);
}

TEST(RecordedPath, ReproducesASteadyMotionOfUnevenSamples) {
    std::string rows;
    for (const double time : {0.0, 0.1, 0.15, 0.4, 0.41, 0.9, 1.0}) {
        rows += std::to_string(time) + "," + std::to_string(2 * time) + ",0,0,0,0,0,1,0\n";
    }
    const RecordedPath hand = parsed(rows);

    for (double time = 0.1; time < 0.9; time += 0.01) {
        EXPECT_NEAR(hand.at(time).pose.position.x(), 2 * time, 1e-9) << time;
    }
}

TEST(RecordedPath, HoldsTheTriggerOfTheLastSample) {
    const RecordedPath hand = parsed(fourRows());

    EXPECT_FALSE(hand.at(0.499).trigger);
    EXPECT_TRUE(hand.at(0.5).trigger);
    EXPECT_TRUE(hand.at(1.499).trigger);
    EXPECT_FALSE(hand.at(1.5).trigger);
}

TEST(RecordedPath, HoldsTheFirstPoseBeforeAndTheLastAfterIt) {
    const RecordedPath hand = parsed(fourRows());

    EXPECT_EQ(hand.at(-1).pose.position, hand.at(0).pose.position);
    for (const double time : {1.5, 2.0, 1e300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_NEAR(hand.at(time).pose.position.x(), 0.9, 1e-12) << time;
    }
    EXPECT_FALSE(hand.finished(1.4999));
    EXPECT_TRUE(hand.finished(1.5));
}

TEST(RecordedPath, CountsTimeFromItsFirstSample) {
    const RecordedPath hand = parsed("10,1,0,0,0,0,0,1,0\n12,3,0,0,0,0,0,1,0\n");

    EXPECT_DOUBLE_EQ(hand.duration(), 2);
    EXPECT_NEAR(hand.at(1).pose.position.x(), 2, 1e-12);
}

TEST(RecordedPath, LoopsAClosedPathAndNeverFinishes) {
    const RecordedPath hand =
        parsed("0,0,0,0,0,0,0,1,0\n1,1,0,0,0,0,0,1,1\n2,2,0,0,0,0,0,1,1\n3,0,0,0,0,0,0,1,0\n",
               PathEnd::Loop);

    for (const double time : {0.3, 1.0, 2.7}) {
        EXPECT_NEAR(hand.at(time + 30).pose.position.x(), hand.at(time).pose.position.x(), 1e-9);
        EXPECT_EQ(hand.at(time + 30).trigger, hand.at(time).trigger);
    }
    EXPECT_FALSE(hand.finished(1e9));
}

TEST(RecordedPath, RefusesToLoopAPathThatEndsElsewhere) {
    const std::string message = refusal(path(fourRows()), PathEnd::Loop);

    EXPECT_NE(message.find("does not end where it began"), std::string::npos) << message;
}

TEST(RecordedPath, TakesBothSignsOfAQuaternionForOneRotation) {
    const RecordedPath hand = parsed("0,0,0,0,0,0,0,1,0\n1,0,0,0,0,0,0,-1,0\n2,0,0,0,0,0,0,1,0\n");

    for (double time = 0; time <= 2; time += 0.1) {
        EXPECT_NEAR(hand.at(time).pose.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0,
                    1e-9);
    }
}

TEST(RecordedPath, ReadsSpacesEmptyLinesAndForeignLineEnds) {
    const RecordedPath hand =
        RecordedPath::parse("# note\r\n\r\n" + Header.substr(0, Header.size() - 1) +
                                "\r\n0, 1 ,0,0,0,0,0,1,0\r\n\r\n# between\r\n1,\t2,0,0,0,0,0,1,1",
                            "hand.csv");

    EXPECT_NEAR(hand.at(0).pose.position.x(), 1, 1e-12);
    EXPECT_NEAR(hand.at(1).pose.position.x(), 2, 1e-12);
    EXPECT_TRUE(hand.at(1).trigger);
}

TEST(RecordedPath, ReadsNumbersTheSameInEveryLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed

    const RecordedPath hand = parsed("0,0.5,0,0,0,0,0,1,0\n0.25,1.5,0,0,0,0,0,1,0\n");

    std::setlocale(LC_ALL, before.c_str());
    EXPECT_NEAR(hand.duration(), 0.25, 1e-12);
    EXPECT_NEAR(hand.at(0).pose.position.x(), 0.5, 1e-12);
}

TEST(RecordedPath, NamesLineColumnAndRemedyOfEveryFault) {
    expectRefused("0,0,0,0,0,0,0,1,0\n1,zero,0,0,0,0,0,1,0\n2,0,0,0,0,0,0,1,2\n",
                  {"hand.csv:4, column 2 (x): 'zero' is no finite number: write it like",
                   "hand.csv:5, column 9 (trigger): neither 0 nor 1: give 1"});
}

TEST(RecordedPath, RefusesWhatIsNoPath) {
    const std::string good = "0,0,0,0,0,0,0,1,0\n";
    expectRefused("", {"has 0 samples: give at least 2"});
    expectRefused(good, {"has 1 samples: give at least 2"});
    expectRefused(good + "1,0,0\n", {"hand.csv:4: has 3 values: give 9"});
    expectRefused(good + "1,0,0,0,0,0,0,1,0,7\n", {"hand.csv:4: has 10 values: give 9"});
    expectRefused(good + "1,nan,0,0,0,0,0,1,0\n", {"hand.csv:4, column 2 (x)"});
    expectRefused(good + "1,0,-inf,0,0,0,0,1,0\n", {"hand.csv:4, column 3 (y)"});
    expectRefused(good + "1,0,0,1e999,0,0,0,1,0\n", {"hand.csv:4, column 4 (z)"});
    expectRefused(good + "1,0,0,1e5,0,0,0,1,0\n", {"hand.csv:4, column 4 (z): beyond 1000 m"});
    expectRefused(good + "1e9,0,0,0,0,0,0,1,0\n", {"hand.csv:4, column 1 (time): beyond"});
    expectRefused(good + "1,0,0,0,0,0,0,0,0\n", {"hand.csv:4: qx, qy, qz, qw is no unit"});
    expectRefused(good + "1,0,0,0,0,0,1,1,0\n", {"hand.csv:4: qx, qy, qz, qw is no unit"});
    expectRefused(good + good, {"hand.csv:4, column 1 (time): time does not rise"});
    expectRefused(good + "1,0,0,0,0,0,1,0,0\n", {"hand.csv:4: turns by more than 60 degrees"});
    expectRefused(good + "1,,0,0,0,0,0,1,0\n", {"hand.csv:4, column 2 (x): ''"});
}

TEST(RecordedPath, RefusesAForeignHeaderByName) {
    const std::string message = refusal("t;x;y\n0;0;0\n");

    EXPECT_NE(message.find("hand.csv:1: expected the header 'time,x,y,z,qx,qy,qz,qw,trigger'"),
              std::string::npos)
        << message;
    EXPECT_NE(refusal(std::string(1000, '\0')).find("expected the header"), std::string::npos);
}

TEST(RecordedPath, KeepsTheReportOfAThousandFaultsShort) {
    std::string rows;
    for (int i = 0; i < 1000; ++i) rows += std::string(500, 'x') + "\n";

    const std::string message = refusal(path(rows));

    EXPECT_LT(message.size(), 4000U);
    EXPECT_NE(message.find("and 980 more"), std::string::npos) << message;
}

TEST(RecordedPath, SurvivesRandomDamage) {
    const std::string good = path(fourRows());
    std::mt19937 engine(1);
    int accepted = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string text = good;
        for (auto edits = 1 + engine() % 3; edits > 0; --edits) {
            const std::size_t place = engine() % text.size();
            const char letter = "0123456789.,-e\n#\0\xff"[engine() % 18];
            if (engine() % 3 == 0) {
                text.erase(place, engine() % 20);
            } else if (engine() % 2 == 0) {
                text[place] = letter;
            } else {
                text.insert(place, 1, letter);
            }
            if (text.empty()) text = "0";
        }
        try {
            const RecordedPath hand = RecordedPath::parse(text, "hand.csv");
            ++accepted;
            for (int i = -1; i <= 20; ++i) {
                const PathSample sample = hand.at(hand.duration() * i / 19);
                ASSERT_TRUE(sample.pose.position.allFinite()) << text;
                ASSERT_NEAR(sample.pose.rotation.norm(), 1, 1e-9) << text;
            }
        } catch (const Error&) {
        }
    }
    EXPECT_GT(accepted, 100);
    EXPECT_LT(accepted, 19900);
}

TEST(RecordedPath, RefusesWhatIsNoReadableFile) {
    for (const std::string file : {"/nonexistent/hand.csv", "/", "/dev/zero"}) {
        try {
            RecordedPath::load(file);
            ADD_FAILURE() << file << " was read";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(file + ": "), std::string::npos);
        }
    }
}

TEST(RecordedPath, RefusesAHugeFileWithoutReadingIt) {
    const cortex::test::ModelFolder folder;
    const auto file = folder.write("huge.csv", Header);
    std::filesystem::resize_file(file, 65ULL << 20);

    EXPECT_THROW(RecordedPath::load(file.string()), Error);
}

TEST(RecordedPath, AllocatesNothingWhileSampling) {
    const RecordedPath hand = parsed(fourRows());
    double sum = 0;

    const auto before = test::allocationCount();
    for (int i = 0; i < 3000; ++i) sum += hand.at(0.001 * i).pose.position.x();
    const auto after = test::allocationCount();

    EXPECT_EQ(after, before);
    EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace cortex::toolkit

// SPDX-License-Identifier: Apache-2.0
// The folders of keys and rights: how they are made, and that a wrong one is refused in words.
#include "security/security_folder.hpp"

#include "cortex/comms/security.hpp"
#include "cortex/core/error.hpp"

#include "comms/secured_plant.hpp"
#include "security/security_documents.hpp"
#include "security/security_identity.hpp"
#include "wire/ids.hpp"

#include <functional>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

namespace fs = std::filesystem;
namespace files = security_files;

std::string errorOf(const std::function<void()>& function) {
    try {
        function();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(SecurityFolder, SaysWhoseItIsAndWhatItMay) {
    const SecuredPlant plant;
    const AgentRights rights = checkSecurity(plant.make("station", {"/cell", "/belt"}, {3, 7}));

    EXPECT_EQ(rights.agent, "station");
    EXPECT_EQ(rights.mayCommand, (std::vector<std::string>{"/cell", "/belt"}));
    EXPECT_EQ(rights.domains, (std::vector{3, 7}));
    EXPECT_GT(utcFrom(rights.until).value_or(0), std::time(nullptr) + 364 * 86'400);
    EXPECT_TRUE(checkSecurity(plant.make("display", {})).mayCommand.empty());
}

TEST(SecurityFolder, KeysAreForTheirOwnerAlone) {
    const SecuredPlant plant;
    const fs::path agent = plant.make("robot");
    for (const fs::path& key : {agent / files::key, plant.authority() / files::identityAuthorityKey,
                                plant.authority() / files::permissionsAuthorityKey}) {
        EXPECT_EQ(fs::status(key).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    }
    EXPECT_EQ(fs::status(agent).permissions(), fs::perms::owner_all);
}

TEST(SecurityFolder, ThatSomebodyElseCanChangeIsRefused) {
    const SecuredPlant plant;
    const fs::path robot = plant.make("robot"), gripper = plant.make("gripper"),
                   camera = plant.make("camera");
    fs::permissions(robot / files::permissionsAuthority, fs::perms::group_write,
                    fs::perm_options::add);
    fs::permissions(gripper, fs::perms::others_write, fs::perm_options::add);

    EXPECT_TRUE(contains(errorOf([&] { checkSecurity(robot); }),
                         "permissions_ca.pem can be written by others: they could change whom this "
                         "agent trusts; chmod go-w "));
    EXPECT_TRUE(contains(errorOf([&] { checkSecurity(gripper); }), "chmod go-w "));
    EXPECT_EQ(errorOf([&] { checkSecurity(camera); }), "");
    fs::permissions(plant.authority(), fs::perms::others_write, fs::perm_options::add);
    EXPECT_TRUE(contains(errorOf([&] { plant.make("arm"); }), "can be written by others"));
    if (geteuid() != 0) GTEST_SKIP() << "only root gives files away";
    ASSERT_EQ(chown((camera / files::commands).c_str(), 12345, 12345), 0);
    EXPECT_TRUE(contains(errorOf([&] { checkSecurity(camera); }),
                         "commands.smime belongs to user 12345, and this program runs as user 0"));
}

TEST(SecurityFolder, IsNeverOverwritten) {
    const SecuredPlant plant;
    const std::string folder = plant.make("robot");
    const std::string before = test::textOf(fs::path{folder} / files::key);

    EXPECT_TRUE(contains(errorOf([&] { plant.make("robot"); }), "name another one"));
    EXPECT_TRUE(contains(errorOf([&] { createAuthority(plant.authority()); }), "name another one"));
    EXPECT_EQ(test::textOf(fs::path{folder} / files::key), before);
}

TEST(SecurityFolder, OfNamesPathsAndDomainsThatCannotBeIsNotMade) {
    const SecuredPlant plant;
    EXPECT_TRUE(contains(errorOf([&] { plant.make("a robot"); }), "cannot name an agent"));
    EXPECT_TRUE(contains(errorOf([&] { plant.make(std::string(49, 'a')); }), "at most 48"));
    EXPECT_TRUE(contains(errorOf([&] { plant.make("robot", {"cell"}); }), "no path"));
    EXPECT_TRUE(contains(errorOf([&] { plant.make("robot", {"/"}, {231}); }), "no domain 231"));
    EXPECT_TRUE(contains(errorOf([&] {
                             createAgent(plant.path("nowhere"), plant.path("robot"),
                                         {"robot", {}, {}, {}});
                         }),
                         "create-authority"));
    EXPECT_FALSE(fs::exists(plant.path("robot")));
}

TEST(SecurityFolder, ThatWasChangedIsRefused) {
    const SecuredPlant plant;
    struct Case {
        const char *file, *from, *to;
    };
    const Case cases[] = {
        {files::governance, "<allow_unauthenticated_participants>false",
         "<allow_unauthenticated_participants>true"},
        {files::permissions, "<default>DENY", "<default>ALLOW"},
        {files::commands, "may-command: /cell", "may-command: /"},
    };
    for (const Case& each : cases) {
        const fs::path folder = plant.make(std::string{"robot-"} + each.file[0], {"/cell"});
        tamper(folder / each.file, each.from, each.to);
        EXPECT_TRUE(contains(errorOf([&] { checkSecurity(folder); }),
                             std::string{each.file} + " was changed"));
    }
}

TEST(SecurityFolder, OfSeveralOwnersIsRefusedWithEverythingThatIsWrong) {
    const SecuredPlant plant;
    const fs::path robot = plant.make("robot"), station = plant.make("station");
    for (const char* each : {files::key, files::permissions, files::commands}) {
        fs::copy_file(station / each, robot / each, fs::copy_options::overwrite_existing);
    }
    const std::string error = errorOf([&] { checkSecurity(robot); });

    EXPECT_TRUE(contains(error, "key.pem is not the key of certificate.pem")) << error;
    EXPECT_TRUE(contains(error, "does not permit 'CN=robot,O=CorteX' anything")) << error;
    EXPECT_TRUE(contains(error, "is that of 'station', and the certificate that of 'robot'"));
}

TEST(SecurityFolder, OfTwoAuthoritiesIsRefused) {
    const SecuredPlant plant, other;
    const fs::path robot = plant.make("robot"), foreign = other.make("robot");
    for (const char* each : {files::certificate, files::key}) {
        fs::copy_file(foreign / each, robot / each, fs::copy_options::overwrite_existing);
    }
    EXPECT_TRUE(contains(errorOf([&] { checkSecurity(robot); }),
                         "certificate.pem is not signed by identity_ca.pem"));
}

TEST(SecurityFolder, WithoutAFileOrWithAnOpenKeyIsRefused) {
    const SecuredPlant plant;
    const fs::path robot = plant.make("robot");
    fs::remove(robot / files::permissions);
    std::ofstream{robot / files::identityAuthority} << "nonsense";
    fs::permissions(robot / files::key, fs::perms::group_read, fs::perm_options::add);
    const std::string error = errorOf([&] { checkSecurity(robot); });

    EXPECT_TRUE(contains(error, "permissions.smime: No such file")) << error;
    EXPECT_TRUE(contains(error, "identity_ca.pem is no certificate")) << error;
    EXPECT_TRUE(contains(error, "chmod 600")) << error;
    EXPECT_TRUE(contains(errorOf([&] { checkSecurity(plant.path("nowhere")); }), "create-agent"));
}

TEST(SecurityFolder, ThatHasExpiredIsRefused) {
    const SecuredPlant plant;
    const fs::path robot = plant.make("robot");
    const auto authority =
        certificateFrom(test::textOf(plant.authority() / files::identityAuthority));
    const auto authorityKey =
        keyFrom(test::textOf(plant.authority() / files::identityAuthorityKey));
    const auto key = keyFrom(test::textOf(robot / files::key));
    const auto expired = newCertificate("robot", key.get(), authority.get(), authorityKey.get(),
                                        std::time(nullptr) - 1);
    std::ofstream{robot / files::certificate} << pemOf(expired.get());

    EXPECT_TRUE(contains(errorOf([&] { checkSecurity(robot); }), "certificate.pem has expired"));
}

TEST(SecurityIdentity, IsForItsAgentItsToolsAndItsDomainsOnly) {
    const SecuredPlant plant;
    const std::string folder = plant.make("station", {"/"}, {3});
    EXPECT_NO_THROW(SecurityIdentity(folder, "station", 3));
    EXPECT_NO_THROW(SecurityIdentity(folder, "station@desk.42", 3));
    EXPECT_TRUE(
        contains(errorOf([&] { SecurityIdentity(folder, "robot", 3); }), "not for 'robot'"));
    EXPECT_TRUE(
        contains(errorOf([&] { SecurityIdentity(folder, "station", 4); }), "not for domain 4"));
}

TEST(SecurityIdentity, NamesAreThoseOfTheParticipantsCertificate) {
    const SecuredPlant plant;
    SecurityIdentity robot{plant.make("robot"), "robot", 0};
    const auto digest = subjectDigest("station");
    GuidPrefix station{0x80};
    for (std::size_t bit = 1; bit < 48; ++bit) {
        const unsigned set = digest[(bit - 1) / 8] >> (7 - (bit - 1) % 8) & 1U;
        station[bit / 8] = static_cast<std::uint8_t>(station[bit / 8] | set << (7 - bit % 8));
    }
    EXPECT_FALSE(robot.maySpeakFor(station, agentId("station")));
    EXPECT_FALSE(robot.maySpeakFor(station, "display"));
    EXPECT_FALSE(robot.hasSpoken(station));
    EXPECT_TRUE(robot.maySpeakFor(station, "station"));
    EXPECT_TRUE(robot.maySpeakFor(station, "station@desk.1"));
    EXPECT_TRUE(robot.maySpeakFor(station, agentId("station")));
    EXPECT_FALSE(robot.maySpeakFor(station, agentId("display")));
    for (std::size_t bit = 0; bit < 48; ++bit) {
        GuidPrefix other = station;
        other[bit / 8] = static_cast<std::uint8_t>(other[bit / 8] ^ 1U << bit % 8);
        EXPECT_FALSE(robot.maySpeakFor(other, "station")) << bit;
    }
}

struct SignedCommand : testing::Test {
    SignedCommand() {
        command.sender = "station@desk.42";
        command.path = "/cell/arm";
        command.command = "startup";
    }
    // Why it is refused; empty: it is not.
    std::string refusal(const Command& sample) {
        std::string why;
        const auto rights = robot.rightsOf(sample, why);
        if (rights) mayCommand(*rights, sample.path, why);
        return why;
    }

    SecuredPlant plant;
    SecurityIdentity robot{plant.make("robot"), "robot", 0};
    SecurityIdentity station{plant.make("station", {"/cell"}), "station", 0};
    Command command;
};

TEST_F(SignedCommand, ProvesWhatItsSenderMay) {
    station.sign(command);
    EXPECT_EQ(refusal(command), "");
}

TEST_F(SignedCommand, OutsideItsPrefixIsRefused) {
    for (const char* path : {"/", "/cello", "/belt", "/robot"}) {
        Command outside = command;
        outside.path = path;
        station.sign(outside);
        EXPECT_EQ(refusal(outside), "its authority ends at /cell") << path;
    }
}

TEST_F(SignedCommand, OfAReaderIsRefused) {
    const SecurityIdentity display{plant.make("display", {}), "display", 0};
    command.sender = "display@desk.1";
    display.sign(command);
    EXPECT_EQ(refusal(command), "it may only look");
}

TEST_F(SignedCommand, ThatWasChangedOrCopiedIsRefused) {
    EXPECT_EQ(refusal(command), "it does not say what it may command");
    station.sign(command);
    Command changed = command;
    changed.path = "/cell/gripper";
    EXPECT_EQ(refusal(changed), "it is not signed with the key of station");
    Command stolen = command;
    stolen.sender = "display@desk.1";
    EXPECT_EQ(refusal(stolen), "its list of commands is that of station");
    Command widened = command;
    std::string& list = widened.extras.front().value;
    list.replace(list.find("may-command: /cell"), 18, "may-command: /    ");
    EXPECT_EQ(refusal(widened),
              "its list of commands was changed, or is not signed by our authority");
}

TEST_F(SignedCommand, OfAnotherAuthorityIsRefused) {
    const SecuredPlant other;
    const SecurityIdentity foreign{other.make("station"), "station", 0};
    foreign.sign(command);
    EXPECT_EQ(refusal(command),
              "its list of commands was changed, or is not signed by our authority");
}

TEST(CommandList, ThatIsNoneIsNotRead) {
    const std::string good = textOf(CommandList{{"a", {"/x"}, {1}, "2027-11-20T12:00:00Z"}, "K"});
    EXPECT_TRUE(commandListFrom(good));
    for (std::size_t size = 0; size < good.size(); ++size) {
        const auto part = commandListFrom(std::string_view{good}.substr(0, size));
        EXPECT_FALSE(part && !part->rights.mayCommand.empty()) << size;
    }
    EXPECT_FALSE(commandListFrom(good + "more"));
    EXPECT_FALSE(commandListFrom(governance()));
}

TEST(CommandList, OfALaterVersionIsReadWithoutWhatOnlyThatKnows) {
    const CommandList list{{"a", {"/x"}, {1}, "2027-11-20T12:00:00Z", {"cell-host"}}, "K"};
    std::string text = textOf(list);
    text.insert(text.find("domain: "), "colour: blue\n");
    text += "owns: /x\n";
    const auto read = commandListFrom(text);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->rights.mayCommand, list.rights.mayCommand);
    EXPECT_EQ(read->rights.domains, list.rights.domains);
    EXPECT_EQ(read->rights.carriedBy, list.rights.carriedBy);
    EXPECT_FALSE(commandListFrom(text + ": nameless\n"));
    EXPECT_FALSE(commandListFrom(text + "domain: none\n"));
}

}  // namespace
}  // namespace cortex::comms

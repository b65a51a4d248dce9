// SPDX-License-Identifier: Apache-2.0
// Control between people on the command line: who is there, asking, and handing over by name.
#include "cortex/comms/lease_client.hpp"

#include "cli/controlled_agent.hpp"
#include "cli/typed_shell.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

struct CortexPeople : CortexControl {
    Outcome runsFile(const std::string& lines, const Words& options = {}) {
        return cortex(
            Words{"shell", folder.write("lines.txt", lines).string(), "--timeout", patient} +
            options + network);
    }
};

json peopleWhen(std::size_t count) {
    return lookUntil([] { return liveJson({"people"}, "people"); },
                     [&](const json& people) { return people.size() == count; });
}

// Until its verb `people` names the other one.
void hear(TypedShell& shell, const std::string& other) { shell.typeUntil("people\r", other); }

TEST_F(CortexPeople, AreListedWithTheirToolsBeforeTheyHoldAnything) {
    EXPECT_TRUE(contains(live({"people"}).output, "nobody is at a window or a shell"));
    TypedShell shell{folder, "Zora of the night"};

    const json before = peopleWhen(1);
    EXPECT_EQ(before[0]["person"], "Zora of the night") << before;
    EXPECT_EQ(before[0]["tool"], shell.name);
    EXPECT_NE(before[0]["host"], "");
    EXPECT_TRUE(before[0]["holds"].empty());
    EXPECT_EQ(before[0]["mine"], false);

    shell.run("take /drive", "cortex [/drive]");
    EXPECT_EQ(leases()[0]["person"], "Zora of the night");
    const Outcome refused = live({"set", "/drive", "naturalFrequency=8", "--take"});
    EXPECT_TRUE(contains(refused.errors, shell.who + " on host ")) << refused.errors;
    EXPECT_TRUE(contains(refused.errors, "'ask /drive' in 'cortex shell'")) << refused.errors;
    shell.run("people", "  /drive  -     you");
}

TEST_F(CortexPeople, AskAndGetAnAnswerThatBothSee) {
    TypedShell alice{folder, "alice"}, bob{folder, "bob"};
    alice.run("take /", "cortex [/]");
    hear(bob, alice.name);
    hear(alice, bob.name);
    const std::string asks = "cortex: " + bob.who +
                             " asks for /drive; 'grant bob' hands over "
                             "everything of mixer, 'refuse bob' refuses";
    alice.run("grant bob", "nobody asks for anything that you hold");
    bob.run("withdraw", "you ask for nothing");

    bob.run("ask /drive", alice.who + " is asked, and holds everything of mixer");
    EXPECT_TRUE(alice.shows(asks)) << alice.output();
    const json people = peopleWhen(2);
    EXPECT_EQ(people[0]["holds"], (json{{{"agent", "mixer"}, {"prefix", "/"}}})) << people;
    EXPECT_EQ(people[1]["asks"], "/drive") << people;
    alice.run("grant", "NAME is required");
    alice.run("refuse", "/drive was refused to " + bob.who);
    EXPECT_TRUE(bob.shows("control of /drive was refused to you by " + alice.who)) << bob.output();

    bob.run("ask /drive", "is asked");
    EXPECT_TRUE(alice.shows(asks)) << alice.output();
    bob.run("withdraw", "you no longer ask for /drive");
    EXPECT_TRUE(alice.shows("cortex: " + bob.who + " no longer asks for /drive"));
    alice.run("grant alice", "nobody asks for anything that you hold");

    bob.run("ask /drive", "is asked");
    EXPECT_TRUE(alice.shows(asks)) << alice.output();
    alice.run("grant bob", "everything of mixer was handed over to " + bob.who);
    EXPECT_TRUE(bob.shows("control of / of agent mixer is yours now")) << bob.output();
    EXPECT_EQ(leases()[0]["person"], "bob");
    const auto first = alice.output().find("no longer asks");
    EXPECT_EQ(alice.output().find("no longer asks", first + 1), std::string::npos)
        << "what she answered herself: " << alice.output();
}

TEST_F(CortexPeople, AreHandedControlByTheirWholeNameWhereOneToolAloneHasIt) {
    TypedShell bob{folder, "Bob of the night"}, alice{folder, "alice"};
    hear(alice, bob.name);
    alice.run("take /drive", "cortex [/drive]");
    alice.run("handover /drive Bob", "no agent, tool or person is called 'Bob'");
    alice.typeLine("handover /drive \"Bob o");
    alice.type("\t");
    EXPECT_TRUE(alice.shows("f the night\" ")) << alice.output();
    alice.type("\r");
    EXPECT_TRUE(alice.shows("/drive was handed over to " + bob.who)) << alice.output();
    EXPECT_TRUE(bob.shows("control of /drive of agent mixer is yours now")) << bob.output();

    const TypedShell other{folder, "alice"};
    hear(bob, other.name);
    hear(bob, alice.name);
    bob.run("handover /drive alice", "several tools say that alice uses them");
    EXPECT_EQ(leases()[0]["person"], "Bob of the night");
    bob.run("handover /drive " + alice.name, "/drive was handed over to " + alice.who);
    EXPECT_TRUE(alice.shows("control of /drive of agent mixer is yours now")) << alice.output();
}

TEST_F(CortexPeople, CannotAskWhereNobodyHoldsAPartOrNobodySaysWhoHeIs) {
    const Holder holder{"/drive"};  // a program

    const Outcome outcome = runsFile(
        "ask /drive\nask /axis\ntake /axis\nask /axis\nask /drvie\nask drive\n", {"--keep-going"});

    EXPECT_EQ(outcome.exit, 1);
    for (const std::string& said :
         {"nobody can be asked for /drive: " + holder.name() +
              " holds /drive of mixer and does not say who uses it",
          std::string{"nobody else holds a part of /axis: 'take /axis' takes it"},
          std::string{"you control /axis yourself"},
          std::string{"'ask /drvie' ended with exit code 3"},
          std::string{"'ask drive' ended with exit code 2"}}) {
        EXPECT_TRUE(contains(outcome.errors, said)) << said << '\n' << outcome.errors;
    }
}

// As another program may tell them: with what turns the text, and what a terminal obeys.
TEST_F(CortexPeople, HaveNamesThatAreShownAsTextAndDoNothing) {
    const std::string hostile = "\u202eecila\u2066 <b>\"\\ 31m";
    const std::string shown = "\\u202eecila\\u2066 <b>\"\\ 31m";
    comms::Mirror mirror{"tool", ownNetwork()};
    mirror.introduce(hostile);
    comms::LeaseClient client{mirror};
    TypedShell alice{folder, "alice"};
    alice.run("take /drive", "cortex [/drive]");
    hear(alice, shown + "  " + mirror.name());

    client.ask("/drive");

    EXPECT_TRUE(alice.shows("cortex: " + shown + " (" + mirror.name() + ") asks for /drive; "))
        << alice.output();
    alice.run("refuse ecila",
              "nobody called 'ecila' asks for anything that you hold, but " + shown);
    alice.run("refuse " + mirror.name(), "/drive was refused to " + shown);
    EXPECT_FALSE(contains(alice.output(), "\u202e"));
}

// Who is called as somebody else's tool gets nothing that is meant for that.
TEST_F(CortexPeople, WithTheNameOfAToolAreNeverMeantByIt) {
    const std::string nobody = "cortex@nowhere.1-abc";
    TypedShell bob{folder, "bob"}, alice{folder, "alice"};
    comms::Mirror mallory{"mallory", ownNetwork()}, eve{"eve", ownNetwork()};
    mallory.introduce(bob.name);
    eve.introduce(nobody);
    for (const std::string& each : {std::string{"bob  "}, mallory.name(), eve.name()})
        hear(alice, each);
    alice.run("take /drive", "cortex [/drive]");
    alice.run("handover /drive " + bob.name, "/drive was handed over to " + bob.who);
    EXPECT_TRUE(bob.shows("control of /drive of agent mixer is yours now")) << bob.output();

    hear(bob, eve.name());
    bob.run("handover /drive " + nobody, "/drive was handed over to " + nobody + ", who must");
}

TEST(CortexPeopleNames, ThatNobodyMayHaveAreRefusedWithARemedy) {
    for (const std::string& wrong :
         {std::string(64, 'x'), std::string(10'000, 'x'), std::string{"a\nb"}, std::string{"\xff"},
          std::string{"alice (cortex@vm.1-2)"}, std::string{" "}}) {
        const Outcome outcome = cortex(Words{"shell", "--name", wrong} + network);
        EXPECT_EQ(outcome.exit, 2) << outcome.output;
        EXPECT_TRUE(contains(outcome.errors, "give another one (--name NAME)")) << outcome.errors;
        EXPECT_LT(outcome.errors.size(), 300U);
    }
}

}  // namespace
}  // namespace cortex::test

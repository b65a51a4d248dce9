// SPDX-License-Identifier: Apache-2.0
// Models at which texts and numbers go wrong are refused by validation, with a place, or are one
// and the same, bit by bit, for the agent that has them, another one, and in what is saved.
#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/core/record.hpp"
#include "cortex/core/type_description.hpp"
#include "cortex/core/validation.hpp"
#include "cortex/core/xml_text.hpp"

#include "agent/agent_model.hpp"
#include "comms/odd_model.hpp"
#include "core/model_folder.hpp"
#include "peers/peer_model.hpp"
#include "support/agent_rig.hpp"
#include "wire/cdr.hpp"
#include "wire/named_values.hpp"
#include "wire/simplex_values.hpp"

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using test::Chance;
using test::difference;

std::size_t modelCount() {
    const char* given = std::getenv("CORTEX_ODD_MODELS");
    return given == nullptr ? 20 : std::stoul(given);
}

// What arrives of a message; the test fails if nothing does.
template <class Message>
Message sent(const Message& message) {
    std::vector<std::uint8_t> payload(encodedSize(message));
    Message arrived;
    EXPECT_EQ(encode(message, payload), payload.size());
    EXPECT_TRUE(decode(payload, arrived));
    return arrived;
}

std::string bits(const std::optional<Number>& bound) {
    if (!bound) return "";
    if (const auto* whole = std::get_if<std::int64_t>(&*bound)) return toText(*whole) + " whole";
    return toText(*bound);
}

void expectSame(const DataItem& ours, const DataItem& theirs) {
    EXPECT_EQ(difference(ours.initial, theirs.initial), "") << ours.name;
    EXPECT_EQ(ours.safe.kind, theirs.safe.kind) << ours.name;
    if (ours.safe.kind == Safe::Kind::Given) {
        EXPECT_EQ(difference(ours.safe.value, theirs.safe.value), "") << ours.name;
    }
    EXPECT_EQ(bits(ours.min), bits(theirs.min)) << ours.name;
    EXPECT_EQ(bits(ours.max), bits(theirs.max)) << ours.name;
    EXPECT_EQ(ours.labels, theirs.labels) << ours.name;
    EXPECT_EQ(ours.description, theirs.description) << ours.name;
}

// An agent of a random model.
class OddAgent {
public:
    explicit OddAgent(std::uint64_t seed) : chance_{seed} {
        folder_.write("t.xml", test::oddOntology(chance_));
        const auto rules = folder_.write("m.xml", test::oddMorphology());
        ModelFiles files = readModelFiles(std::span{&rules, 1}, report);
        if (!report.ok()) return;
        const auto system = folder_.write("s.xml", test::oddSystem(chance_, files.types));
        files = readModelFiles(std::span{&system, 1}, report);
        rig_.emplace(std::move(files.types), "rig");
        if (report.ok()) rig_->tree.add(files.system, nullptr, report);
        if (report.ok()) start();
    }
    void run() {
        tellAnother();
        if (!testing::Test::HasFailure()) sendValues();
        if (!testing::Test::HasFailure()) saveAndRestore();
        if (!testing::Test::HasFailure()) judgeValues();
    }

    Report report;  // with an error: it is refused

private:
    void start() {
        try {
            rig_->start();
            rig_->step();
        } catch (const ModelError& refused) {
            report.append(refused.report());
        }
    }
    const Structure& structure() const { return rig_->agent->structure(); }

    void tellAnother() {
        const AgentSelf self{rig_->outside.access};
        const AgentModel model{self};
        PeerModel peer{"rig", structure().epoch};
        peer.add(sent(model.presence("running", 1, 0)));
        for (const Model& each : model.samples()) ASSERT_TRUE(peer.add(sent(each)));
        other_ = peer.structure();
        ASSERT_TRUE(other_) << peer.findings().text();
        for (const auto& [name, type] : other_->types->types()) {
            const Type& ours = structure().types->at(name);
            EXPECT_EQ(canonicalText(ours), canonicalText(type));
            for (std::size_t i = 0; i < ours.data.size(); ++i) {
                expectSame(ours.data[i], type.data[i]);
            }
        }
    }

    // By constants of the model and by a block.
    void sendValues() {
        const Image image = rig_->agent->images().newest();
        Block block;
        for (std::uint32_t i = 0; i < structure().simplexes.size(); ++i) {
            block.simplexes.emplace_back();
            readValues(i, *structure().simplexes[i].layout, image.slice(i), block.simplexes.back());
        }
        const Block arrived = sent(block);
        for (std::uint32_t i = 0; i < structure().simplexes.size(); ++i) {
            const TypeLayout& layout = *other_->simplexes[i].layout;
            ASSERT_EQ(misfit(arrived.simplexes[i], layout), "");
            const SliceMemory memory{layout};
            storeValues(arrived.simplexes[i], layout, memory.slice());
            for (const ItemLayout& item : layout.items) {
                if (item.constant) continue;
                const void* cells = memory.slice().at(item.item->kind, item.offset);
                EXPECT_EQ(
                    difference(valueOf(image, i, item.item->name), loadValue(*item.item, cells)),
                    "")
                    << item.item->name;
            }
        }
    }

    static Value valueOf(const Image& image, std::uint32_t simplex, const std::string& item) {
        return image.value(simplex, *image.structure().simplexes[simplex].layout->find(item));
    }

    // As `cortex save` and the file of retained values have it.
    void saveAndRestore() {
        const Image image = rig_->agent->images().newest();
        std::string text = "<system name='saved'>\n";
        for (std::uint32_t i = 0; i < structure().simplexes.size(); ++i) {
            const SimplexInfo& info = structure().simplexes[i];
            text += "<simplex path='" + info.path + "' type='" + info.layout->type->name + "'>\n";
            for (const ItemLayout& item : info.layout->items) {
                text += setElement(item.item->name, toText(image.value(i, item))) + "\n";
            }
            text += "</simplex>\n";
        }
        const auto file = folder_.write("saved.xml", text + "</system>");
        Report found;
        const ModelFiles saved = readModelFiles(std::span{&file, 1}, found);
        ASSERT_TRUE(found.ok()) << found.text();
        for (const auto& simplex : saved.system.simplexes) {
            const std::uint32_t index = structure().find(simplex.path);
            for (const auto& setting : simplex.settings) expectRestored(image, index, setting);
        }
    }
    void expectRestored(const Image& image, std::uint32_t simplex,
                        const SystemDescription::Setting& setting) const {
        const ItemLayout* item = structure().simplexes[simplex].layout->find(setting.data);
        std::string why;
        const auto value = parseItemValue(*item->item, setting.value, why);
        ASSERT_TRUE(value) << setting.data << ": " << why;
        EXPECT_EQ(difference(image.value(simplex, *item), *value), "") << setting.data;
    }

    // Any value is refused for a reason, or goes through a command and a file as it is.
    void judgeValues() {
        std::vector<std::pair<const DataItem*, Value>> carried;
        std::string text = "<system name='saved'><simplex path='/a' type='A'>\n";
        for (const SimplexInfo& info : structure().simplexes) {
            for (const ItemLayout& each : info.layout->items) {
                const DataItem& item = *each.item;
                if (!test::isOdd(item) || info.path == "/Plain") continue;  // /Wide has them, too
                Value value = test::oddValue(chance_, item);
                if (!valueError(item, value).empty()) continue;
                expectSent(item, value);
                text += setElement(item.name + std::to_string(carried.size()), toText(value));
                carried.emplace_back(&item, std::move(value));
            }
        }
        const auto file = folder_.write("values.xml", text + "</simplex></system>");
        Report found;
        const ModelFiles saved = readModelFiles(std::span{&file, 1}, found);
        ASSERT_TRUE(found.ok()) << found.text();
        for (std::size_t i = 0; i < carried.size(); ++i) {
            const auto& [item, value] = carried[i];
            std::string why;
            const auto read =
                parseItemValue(*item, saved.system.simplexes.front().settings[i].value, why);
            ASSERT_TRUE(read) << item->name << ": " << why;
            EXPECT_EQ(difference(value, *read), "") << item->name;
        }
    }
    static void expectSent(const DataItem& item, const Value& value) {
        Command command;
        command.arguments = {namedValue(item.name, value)};
        const auto arrived = comms::valueOf(sent(command).arguments.front());
        ASSERT_TRUE(arrived);
        EXPECT_EQ(difference(value, *arrived), "") << item.name;
    }

    Chance chance_;
    const test::ModelFolder folder_;
    std::optional<test::AgentRig> rig_;
    std::shared_ptr<const Structure> other_;
};

TEST(OddModels, AreRefusedWithAPlaceOrTheSameEverywhere) {
    std::size_t refused = 0;
    for (std::uint64_t seed = 1; seed <= modelCount(); ++seed) {
        SCOPED_TRACE(seed);
        OddAgent agent{seed};
        if (agent.report.ok()) {
            agent.run();
        } else {
            ++refused;
            for (const Finding& each : agent.report.findings) {
                EXPECT_GT(each.place.line, 0) << each.text();
                EXPECT_FALSE(each.remedy.empty()) << each.text();
            }
        }
        if (testing::Test::HasFailure()) break;
    }
    RecordProperty("refused", std::to_string(refused));
    EXPECT_GT(refused, modelCount() / 20);
    EXPECT_LT(refused, modelCount() / 4 * 3);
}

}  // namespace
}  // namespace cortex::comms

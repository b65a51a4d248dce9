// SPDX-License-Identifier: Apache-2.0
#include "comms/sample_messages.hpp"
#include "support/own_domain.hpp"
#include "wire/cdr.hpp"

#include <cortex.h>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

constexpr const char* loopbackOnly =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='false'/>"
    "</Interfaces></General></Domain></CycloneDDS>";

template <class M, class C, const dds_topic_descriptor_t* Description>
struct Pair {
    using Message = M;
    using CycloneMessage = C;
    static constexpr const dds_topic_descriptor_t* description = Description;
};
using Pairs = testing::Types<Pair<Presence, cortex_Presence, &cortex_Presence_desc>,
                             Pair<Model, cortex_Model, &cortex_Model_desc>,
                             Pair<Interest, cortex_Interest, &cortex_Interest_desc>,
                             Pair<Block, cortex_Block, &cortex_Block_desc>,
                             Pair<Summary, cortex_Summary, &cortex_Summary_desc>,
                             Pair<Command, cortex_Command, &cortex_Command_desc>,
                             Pair<Answer, cortex_Answer, &cortex_Answer_desc>,
                             Pair<EventMessage, cortex_EventMessage, &cortex_EventMessage_desc>,
                             Pair<PastMessage, cortex_Past, &cortex_Past_desc>>;

struct ShortNames {
    template <class P>
    static std::string GetName(int) {
        return std::string{P::Message::typeName}.substr(sizeof "cortex::" - 1);
    }
};

// A domain of its own; Cyclone's codec is had from a first, empty message that it wrote itself.
template <class P>
class Cyclone : public testing::Test {
protected:
    void SetUp() override {
        const auto number = static_cast<dds_domainid_t>(test::ownDomain());
        domain_ = dds_create_domain(number, loopbackOnly);
        ASSERT_GT(domain_, 0) << dds_strretcode(domain_);
        const dds_entity_t participant = dds_create_participant(number, nullptr, nullptr);
        ASSERT_GT(participant, 0) << dds_strretcode(participant);
        const dds_entity_t topic =
            dds_create_topic(participant, P::description, "messages", nullptr, nullptr);
        const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, nullptr);
        const dds_entity_t writer = dds_create_writer(participant, topic, nullptr, nullptr);
        const typename P::CycloneMessage empty{};
        ASSERT_EQ(dds_write(writer, &empty), DDS_RETCODE_OK);
        dds_sample_info_t info;
        ASSERT_EQ(dds_takecdr(reader, &first_, 1, &info, DDS_ANY_STATE), 1);
    }
    void TearDown() override {
        if (first_ != nullptr) ddsi_serdata_unref(first_);
        dds_delete(domain_);
    }

    // Read by Cyclone into its own struct, and written by it from there; empty: refused.
    Octets throughCyclone(Octets payload) {
        const ddsrt_iovec_t piece{payload.data(), payload.size()};
        ddsi_serdata* read =
            ddsi_serdata_from_ser_iov(first_->type, SDK_DATA, 1, &piece, payload.size());
        if (read == nullptr) return {};
        typename P::CycloneMessage message{};
        Octets written;
        if (ddsi_serdata_to_sample(read, &message, nullptr, nullptr)) {
            ddsi_serdata* copy = ddsi_serdata_from_sample(first_->type, SDK_DATA, &message);
            written.resize(ddsi_serdata_size(copy));
            ddsi_serdata_to_ser(copy, 0, written.size(), written.data());
            ddsi_serdata_unref(copy);
        }
        dds_sample_free(&message, P::description, DDS_FREE_CONTENTS);
        ddsi_serdata_unref(read);
        return written;
    }

private:
    dds_entity_t domain_ = 0;
    ddsi_serdata* first_ = nullptr;
};
TYPED_TEST_SUITE(Cyclone, Pairs, ShortNames);

// Except that Cyclone appends padding and says in the header how much.
TYPED_TEST(Cyclone, ReadsAndWritesTheSameOctets) {
    using Message = typename TypeParam::Message;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Message message = randomMessage<Message>(seed);
        Octets payload(encodedSize(message));
        ASSERT_EQ(encode(message, payload), payload.size()) << "seed " << seed;

        Octets written = this->throughCyclone(payload);

        Message read;
        ASSERT_TRUE(decode(written, read)) << "seed " << seed;
        ASSERT_EQ(read, message) << "seed " << seed;
        ASSERT_EQ(written.size(), (payload.size() + 3) / 4 * 4) << "seed " << seed;
        ASSERT_EQ(written[3], written.size() - payload.size()) << "seed " << seed;
        written.resize(payload.size());
        written[3] = payload[3];
        ASSERT_EQ(written, payload) << "seed " << seed;
    }
}

}  // namespace
}  // namespace cortex::comms

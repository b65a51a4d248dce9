// SPDX-License-Identifier: Apache-2.0
#include "dds/participant.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/service_threads.hpp"

#include "dds/discovery_counter.hpp"
#include "dds/gate.hpp"
#include "dds/participant_qos.hpp"
#include "dds/receiver.hpp"
#include "dds/security_guard.hpp"
#include "dds/topic_type.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

namespace cortex::comms {
namespace {

namespace dds = eprosima::fastdds::dds;
using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;

// Participants, up to which what is said of endpoints is sent three times.
constexpr std::uint32_t mostForRepeats = 16;

template <class Entity>
Entity* created(Entity* entity, const std::string& what) {
    if (!entity) {
        throw Error{what +
                    " was refused by Fast DDS; run again with CORTEX_DDS_LOG=warning in "
                    "the environment to see its reason"};
    }
    return entity;
}

rtps::WriterGuid writerGuid(const DiscoveryCounter::Guid& guid) {
    rtps::WriterGuid bytes;
    std::ranges::copy(guid.guidPrefix.value, bytes.begin());
    std::ranges::copy(guid.entityId.value, bytes.begin() + sizeof guid.guidPrefix.value);
    return bytes;
}

}  // namespace

// So each participant receives at most twenty announcements a second.
std::chrono::milliseconds announcementsAmong(std::uint32_t participants) {
    return std::chrono::milliseconds{std::clamp(50 * participants, 100U, 3'000U)};
}

struct Participant::Impl {
    std::string name;
    std::unique_ptr<DiscoveryCounter> listener;              // outlives the participant
    std::vector<std::unique_ptr<DiscoveryCounter>> retired;  // others may know their identities
    SecurityGuard* guard = nullptr;                          // the listener, with security
    std::shared_ptr<Gate> gate;
    int othersOnHost = 0;
    dds::DomainParticipant* participant = nullptr;
    dds::Publisher* publisher = nullptr;
    dds::Subscriber* subscriber = nullptr;
    std::map<std::string, dds::Topic*, std::less<>> topics;
    std::atomic<std::uint64_t> malformed = 0;
    std::uint64_t announcements = 0;
    std::chrono::steady_clock::time_point announceDue{};

    ~Impl() { leave(); }

    void leave() {
        if (participant == nullptr) return;
        participant->delete_contained_entities();
        dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
        participant = nullptr;
    }

    // To be called with the gate held, as everything that makes or deletes endpoints.
    template <class M>
    dds::Topic* topic(const std::string& topicName) {
        if (const auto found = topics.find(topicName); found != topics.end()) return found->second;
        if (participant->find_type(M::typeName).empty()) {
            dds::TypeSupport{new TopicType<M>}.register_type(participant);
        }
        dds::Topic* made =
            created(participant->create_topic(topicName, M::typeName, dds::TOPIC_QOS_DEFAULT),
                    "topic '" + topicName + "' of '" + name + "'");
        topics.emplace(topicName, made);
        return made;
    }

    // Deletes the topic if no endpoint uses it.
    void release(const dds::TopicDescription* used) {
        const auto found = topics.find(used->get_name());
        if (participant->delete_topic(found->second) == ReturnCode::RETCODE_OK) topics.erase(found);
    }
};

// --- Writer -------------------------------------------------------------------------------------

template <class M>
struct Writer<M>::Impl {
    std::shared_ptr<Gate> gate;
    std::function<void(const dds::TopicDescription*)> release;
    dds::Publisher* publisher;
    dds::DataWriter* writer;
    // With security, the sending thread of Fast DDS 2.9 ends the process if the last reader of a
    // writer goes while a message to it is being put together. So the writer has a reader of its
    // own, which goes after it.
    std::unique_ptr<Reader<M>> ours;
};

template <class M>
Writer<M>::Writer(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}

template <class M>
Writer<M>::~Writer() {
    // Fast DDS 2.9 frees a history while heartbeats may still read it, and can then loop for ever.
    // An empty history is safe.
    const auto held = impl_->gate->hold();
    std::size_t removed = 0;
    impl_->writer->clear_history(&removed);
    const dds::TopicDescription* const topic = impl_->writer->get_topic();
    impl_->publisher->delete_datawriter(impl_->writer);
    impl_->release(topic);
}

template <class M>
bool Writer<M>::write(const M& message) {
    Envelope<M> envelope{&message, {}, false};
    if (impl_->writer->write(&envelope)) return true;
    if (!canEncode(message)) impl_->gate->unsent.add(M::typeName);
    return false;
}

template <class M>
bool Writer<M>::dispose(const M& message)
    requires Keyed<M>
{
    Envelope<M> envelope{&message, {}, false};
    return impl_->writer->dispose(&envelope, dds::HANDLE_NIL) == ReturnCode::RETCODE_OK;
}

template <class M>
std::uint32_t Writer<M>::readers() const {
    dds::PublicationMatchedStatus status;
    impl_->writer->get_publication_matched_status(status);
    return static_cast<std::uint32_t>(status.current_count);
}

// --- Reader -------------------------------------------------------------------------------------

template <class M>
struct Reader<M>::Impl {
    std::shared_ptr<Gate> gate;
    std::function<void(const dds::TopicDescription*)> release;
    dds::Subscriber* subscriber;
    Receiver<M> receiver;
    dds::DataReader* reader;
};

template <class M>
Reader<M>::Reader(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}

template <class M>
Reader<M>::~Reader() {
    impl_->receiver.close();
    const auto held = impl_->gate->hold();
    const dds::TopicDescription* const topic = impl_->reader->get_topicdescription();
    impl_->subscriber->delete_datareader(impl_->reader);
    impl_->release(topic);
}

template <class M>
std::uint32_t Reader<M>::writers() const {
    return impl_->receiver.writers(impl_->gate->filter);
}

template <class M>
bool Reader<M>::isDeaf() const {
    return impl_->receiver.isDeaf(impl_->gate->filter);
}

template <class M>
std::uint32_t Reader<M>::unheard() const {
    return impl_->receiver.unheard(impl_->gate->filter);
}

// --- Participant --------------------------------------------------------------------------------

Participant::Participant(const NetworkOptions& options, const std::string& name, Speaks speaks)
    : impl_{std::make_unique<Impl>()} {
    impl_->name = name;
    if (!options.security.empty()) {
        auto guard = std::make_unique<SecurityGuard>(options.security, name, options.domain);
        impl_->guard = guard.get();
        impl_->listener = std::move(guard);
    } else {
        impl_->listener = std::make_unique<DiscoveryCounter>();
    }
    const ServiceThreads named{"cortex-dds"};
    static std::mutex joining;  // Fast DDS looks up the user, which is not safe for two threads
    const std::lock_guard lock{joining};
    dds::DomainParticipantQos qos = participantQos(options, name);
    impl_->gate = addGate(qos, options.domain, !options.discoveryServer.empty());
    impl_->listener->onWriter = [gate = impl_->gate](const auto& guid, std::string_view topic) {
        if (mayBeFragmented(topic)) {
            gate->filter.allowFragments(writerGuid(guid), topic == topics::model.name,
                                        monotonicNow());
        }
    };
    const bool isOpen = impl_->guard == nullptr;  // what is signed is sent once
    impl_->gate->repeatsEndpoints = isOpen;
    impl_->listener->onKnown = [gate = impl_->gate, isOpen](std::uint32_t known) {
        gate->repeatsEndpoints = isOpen && known <= mostForRepeats;
    };
    setUpFastDds();
    const std::string where = " of '" + name + "' in domain " + std::to_string(options.domain);
    const auto join = [&] {
        return dds::DomainParticipantFactory::get_instance()->create_participant(
            static_cast<dds::DomainId_t>(options.domain), qos, impl_->listener.get(),
            dds::StatusMask::none());  // participants are reported without a mask
    };
    impl_->participant = join();
    if (impl_->participant == nullptr) {
        // Another participant of this process may have the number and not the port. Fast DDS then
        // chooses.
        qos.wire_protocol().participant_id = -1;
        impl_->participant = created(join(), "the network membership" + where);
    }
    impl_->othersOnHost = std::max(qos.wire_protocol().participant_id, 0);
    impl_->publisher = created(impl_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT),
                               "the publisher" + where);
    impl_->subscriber = created(impl_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT),
                                "the subscriber" + where);
    if (speaks == Speaks::AtOnce) speak();
}

void Participant::speak() { impl_->gate->open(); }

void Participant::stopListening() { impl_->gate->close(); }

Participant::Participant(Participant&& other) noexcept = default;

Participant::~Participant() = default;

void Participant::replaceBy(Participant&& next) {
    impl_->leave();
    next.impl_->retired = std::move(impl_->retired);
    next.impl_->retired.push_back(std::move(impl_->listener));
    next.impl_->malformed += impl_->malformed;
    impl_ = std::move(next.impl_);
}

template <class M>
std::unique_ptr<Writer<M>> Participant::writer(const Topic& topic) {
    using Entity = typename Writer<M>::Impl;
    auto held = impl_->gate->hold();
    dds::DataWriter* made =
        created(impl_->publisher->create_datawriter(
                    impl_->topic<M>(topic.name),
                    writerQos(topic.qos, impl_->othersOnHost, impl_->guard != nullptr)),
                "a writer of topic '" + topic.name + "' of '" + impl_->name + "'");
    if (topic.name == topics::model.name) {
        const auto& id = made->guid().entityId.value;
        impl_->gate->cutWriter =
            static_cast<std::uint32_t>(id[0] << 24 | id[1] << 16 | id[2] << 8 | id[3]);
    }
    const auto release = [self = impl_.get()](auto* used) { self->release(used); };
    std::unique_ptr<Writer<M>> writer{new Writer<M>{std::unique_ptr<Entity>{
        new Entity{impl_->gate, release, impl_->publisher, made, nullptr}}}};
    held.unlock();
    if (impl_->guard != nullptr && isSentByThread(topic.qos)) {
        writer->impl_->ours = reader<M>({topic.name, Qos::Cycle}, [](M&&) {});
    }
    return writer;
}

template <class M>
std::unique_ptr<Reader<M>> Participant::reader(const Topic& topic,
                                               std::function<void(M&&)> onSample,
                                               std::function<void(const Id&)> onDisposed) {
    using Entity = typename Reader<M>::Impl;
    const auto held = impl_->gate->hold();
    dds::Topic* const made = impl_->topic<M>(topic.name);
    std::unique_ptr<Entity> entity{
        new Entity{impl_->gate,
                   [self = impl_.get()](auto* used) { self->release(used); },
                   impl_->subscriber,
                   {std::move(onSample), std::move(onDisposed), impl_->malformed, impl_->guard},
                   nullptr}};
    entity->reader =
        created(impl_->subscriber->create_datareader(
                    made, readerQos(topic.qos, impl_->othersOnHost), &entity->receiver,
                    dds::StatusMask::data_available() << dds::StatusMask::subscription_matched()),
                "a reader of topic '" + topic.name + "' of '" + impl_->name + "'");
    return std::unique_ptr<Reader<M>>{new Reader<M>{std::move(entity)}};
}

void Participant::announce() {
    Impl& self = *impl_;
    const auto now = std::chrono::steady_clock::now();
    if (now < self.announceDue) return;
    self.announceDue = now + announcementsAmong(self.listener->known());
    // Fast DDS announces a change at once, and then also looks for new interfaces. It then takes
    // its locks in another order than where it receives.
    const auto held = self.gate->hold();
    dds::DomainParticipantQos qos = self.participant->get_qos();
    qos.user_data().data_vec({static_cast<std::uint8_t>(++self.announcements)});
    self.participant->set_qos(qos);
}

std::uint64_t Participant::malformed() const { return impl_->malformed; }

SecurityIdentity* Participant::identity() const {
    return impl_->guard ? &impl_->guard->identity() : nullptr;
}

std::vector<std::string> Participant::takeRefusals() {
    auto refusals = impl_->guard ? impl_->guard->takeRefusals() : std::vector<std::string>{};
    std::ranges::move(impl_->gate->filter.takeReports(monotonicNow()),
                      std::back_inserter(refusals));
    std::ranges::move(impl_->gate->unsent.takeReports(), std::back_inserter(refusals));
    return refusals;
}

std::uint64_t Participant::refused() const {
    return impl_->gate->filter.dropped() + (impl_->guard ? impl_->guard->refused() : 0);
}

std::map<std::string, Participant::Refused> Participant::refusals() const {
    std::map<std::string, Refused> all{
        {"a sample could not be decoded", {malformed(), ""}},
        {"a sample could not be encoded", {impl_->gate->unsent.count(), ""}},
        {"security refused their sender", {impl_->guard ? impl_->guard->refused() : 0, ""}}};
    const rtps::DatagramFilter& filter = impl_->gate->filter;
    for (std::size_t i = 0; i < rtps::refusals; ++i) {
        const auto reason = static_cast<rtps::Refusal>(i);
        all[std::string{"datagrams: "} + rtps::wordsOf(reason)] = {filter.dropped(reason),
                                                                   filter.lastSender(reason)};
    }
    std::erase_if(all, [](const auto& each) { return each.second.count == 0; });
    return all;
}
std::string Participant::dropped() const { return impl_->gate->filter.summary(); }

std::uint32_t Participant::pending() const { return impl_->guard ? impl_->guard->pending() : 0; }
bool Participant::findsUnproven() const { return impl_->guard && impl_->guard->findsUnproven(); }

std::uint32_t Participant::secured() const { return impl_->listener->secured(); }

// --- the messages -------------------------------------------------------------------------------

using OnDisposed = std::function<void(const Id&)>;

// A type cannot stand in parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
#define CORTEX_MESSAGE(M)                                                  \
    template class Writer<M>;                                              \
    template class Reader<M>;                                              \
    template std::unique_ptr<Writer<M>> Participant::writer(const Topic&); \
    template std::unique_ptr<Reader<M>> Participant::reader(const Topic&,  \
                                                            std::function<void(M&&)>, OnDisposed)
// NOLINTEND(bugprone-macro-parentheses)

CORTEX_MESSAGE(Presence);
CORTEX_MESSAGE(Model);
CORTEX_MESSAGE(Interest);
CORTEX_MESSAGE(Block);
CORTEX_MESSAGE(Summary);
CORTEX_MESSAGE(Command);
CORTEX_MESSAGE(Answer);
CORTEX_MESSAGE(EventMessage);
CORTEX_MESSAGE(PastMessage);

#undef CORTEX_MESSAGE

}  // namespace cortex::comms

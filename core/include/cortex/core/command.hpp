// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/data.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/structure.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cortex {

enum class Outcome : std::uint8_t {
    None,  // not sent yet, or no answer yet
    Done,
    Running,   // accepted, not finished
    Rejected,  // not executed; see Reason
    Failed,    // executed, without success
    Cancelled,
    MailboxFull,  // not executed
    Expired,      // surely not executed
    Unknown       // no answer: it may have run
};
enum class Reason : std::uint8_t {
    None,
    State,
    Range,
    Busy,
    Authority,
    Restarted,
    Window,
    UnknownCommand
};

const char* name(Outcome outcome);
const char* name(Reason reason);
std::optional<Outcome> outcomeFromName(std::string_view text);
std::optional<Reason> reasonFromName(std::string_view text);

// Who sent a command from outside: an agent or a tool, and its start (UTC microseconds).
struct Sender {
    std::array<char, 64> name{}, host{};  // zero-terminated
    std::int64_t epoch = 0;

    std::string_view nameText() const { return name.data(); }
    bool operator==(const Sender&) const = default;
};

// Offset of a parameter that populate() has not got; using it throws UnboundHandle.
inline constexpr std::uint32_t unboundParameter = 0xffffffffU;

// Offset of a command parameter, got in populate(): Argument for the request, Result for the
// response. Used on the Call inside a handler.
template <class T>
struct Argument {
    std::uint32_t offset = unboundParameter;
};
// Handle to one scalar parameter of a response; for handlers.
template <class T>
struct Result {
    std::uint32_t offset = unboundParameter;
};
// The same of array parameters, which the Call shows as spans.
template <ArrayElement T>
struct ArrayArgument {
    std::uint32_t offset = unboundParameter, length = 0;
};
// The same for an array.
template <ArrayElement T>
struct ArrayResult {
    std::uint32_t offset = unboundParameter, length = 0;
};

// One execution of a command, seen by its handler. Arguments were checked before.
class Call {
public:
    Call(const std::byte* request, std::byte* response) : request_{request}, response_{response} {}

    template <class T>
    CellReference<const T> operator[](Argument<T> argument) const CORTEX_REALTIME {
        using Cell = typename StorageOf<const T>::type;
        return CellReference<const T>{
            reinterpret_cast<Cell*>(request_ + bound<T>(argument.offset, "Argument"))};
    }
    template <class T>
    CellReference<T> operator[](Result<T> result) CORTEX_REALTIME {
        using Cell = typename StorageOf<T>::type;
        return CellReference<T>{
            reinterpret_cast<Cell*>(response_ + bound<T>(result.offset, "Result"))};
    }
    template <class T>
    std::span<const T> operator[](ArrayArgument<T> argument) const CORTEX_REALTIME {
        const std::uint32_t offset = bound<T>(argument.offset, "ArrayArgument");
        return {reinterpret_cast<const T*>(request_ + offset), argument.length};
    }
    template <class T>
    std::span<T> operator[](ArrayResult<T> result) CORTEX_REALTIME {
        const std::uint32_t offset = bound<T>(result.offset, "ArrayResult");
        return {reinterpret_cast<T*>(response_ + offset), result.length};
    }
    bool first() const { return first_; }            // false when a long command is called again
    bool cancelling() const { return cancelling_; }  // its last call
    // Nominal time of this cycle, as Tick::seconds(), and since the first call of a long command.
    double seconds() const { return static_cast<double>(now_) * 1e-9; }
    double elapsedSeconds() const { return static_cast<double>(now_ - begun_) * 1e-9; }
    // Why it failed, in words; returns Failed so that a handler can `return call.fail("…")`.
    Outcome fail(std::string_view why) CORTEX_REALTIME;
    // Not executed: `return call.reject(Reason::State, "…")`.
    Outcome reject(Reason reason, std::string_view why) CORTEX_REALTIME;
    std::string_view why() const { return why_ ? why_->view() : std::string_view{}; }
    Reason reason() const { return reason_; }
    // The agent or tool that sent it from outside; null along a relationship.
    const Sender* sender() const { return sender_; }
    std::string_view onBehalfOf() const { return person_; }  // as its sender says; often empty

    void setFirst(bool first) { first_ = first; }
    void setCancelling(bool cancelling) { cancelling_ = cancelling; }
    void setSender(const Sender* sender) { sender_ = sender; }
    void setOnBehalfOf(std::string_view person) { person_ = person; }
    void setTime(std::int64_t now, std::int64_t begun) {  // nominal, ns
        now_ = now;
        begun_ = begun;
    }

private:
    template <class T>
    static std::uint32_t bound(std::uint32_t offset, const char* form) CORTEX_REALTIME {
        if (offset == unboundParameter) [[unlikely]]
            throwUnbound({form, kindFor<T>(), false});
        return offset;
    }

    const std::byte* request_;
    std::byte* response_;
    const Sender* sender_ = nullptr;
    std::string_view person_;
    std::int64_t now_ = 0, begun_ = 0;
    bool first_ = true, cancelling_ = false;
    Reason reason_ = Reason::None;
    std::optional<EventText> why_;
};

// A command handler bound to an object without std::function.
struct Handler {
    using Function = Outcome (*)(void* object, Call& call);
    void* object = nullptr;
    Function function = nullptr;

    Outcome operator()(Call& call) const { return function(object, call); }
};

// What one parameter or settable item is checked against, compiled from its DataItem.
struct ArgumentCheck {
    const DataItem* item = nullptr;
    std::uint32_t offset = 0;  // bytes
    std::uint32_t length = 1;
    Kind kind = Kind::Float;
    bool closed = false;  // only labelled numbers: an item with labels and no range
    std::int64_t minInt = 0, maxInt = 0;
    double minFloat = 0, maxFloat = 0;
};

// The commands of one type as the runtime sees them: those of the type, sorted; `cancel` where one
// of them is long; last `set` where the type has settable items. The request of `set` holds a
// presence flag (one byte) per settable item, then the items.
struct CommandTable {
    struct Entry {
        const Command* command = nullptr;  // null for `cancel` and `set`
        std::string_view name;
        RecordLayout request, response;
        StateSet available;
        bool isShort = false;                  // executed by its handler in one call
        std::vector<ArgumentCheck> checks;     // of the request
        std::vector<std::byte> emptyResponse;  // initialised
        std::vector<ArgumentCheck> floats;     // of the response
    };
    std::vector<Entry> entries;
    std::vector<const DataItem*> settable;  // in the order of the flags
    std::uint32_t maxRequest = 0, maxResponse = 0;
    bool hasLong = false;

    static constexpr std::uint32_t none = 0xffffffffU;
    std::uint32_t find(std::string_view command) const;
};

CommandTable commandTable(const Type& type);

// The three life-cycle commands bypass mailboxes: a pending word that is never full.
enum class LifeCycle : std::uint8_t { None, Startup, Shutdown, ClearFaults };
LifeCycle lifeCycleCommand(std::string_view command);

EventText checkArguments(const RecordLayout& layout, const std::byte* record);  // "" if good
void initialiseRecord(const RecordLayout& layout, std::byte* record);

}  // namespace cortex

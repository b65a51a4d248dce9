// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/data.hpp"
#include "cortex/core/event.hpp"
#include "cortex/core/structure.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cortex {

enum class Outcome : std::uint8_t {
    None,         // not sent yet, or no answer yet
    Done,
    Running,      // accepted, not finished
    Rejected,     // not executed; see Reason
    Failed,       // executed, without success
    Cancelled,
    MailboxFull,  // not executed
    Expired,      // surely not executed
    Unknown       // no answer: it may have run
};
enum class Reason : std::uint8_t {
    None, State, Range, Busy, Authority, Restarted, Window, UnknownCommand
};

const char* name(Outcome outcome);
const char* name(Reason reason);

// Offset of a command parameter, got in populate(): Argument for the request, Result for the
// response. Used on the Call inside a handler.
template <class T>
struct Argument {
    std::uint32_t offset = 0;
};
template <class T>
struct Result {
    std::uint32_t offset = 0;
};

// One execution of a command, seen by its handler. Arguments were checked before.
class Call {
public:
    Call(const std::byte* request, std::byte* response) : request_{request}, response_{response} {}

    template <class T>
    Data<const T> operator[](Argument<T> argument) const CORTEX_REALTIME {
        using Cell = typename StorageOf<const T>::type;
        return Data<const T>{reinterpret_cast<Cell*>(request_ + argument.offset)};
    }
    template <class T>
    Data<T> operator[](Result<T> result) CORTEX_REALTIME {
        using Cell = typename StorageOf<T>::type;
        return Data<T>{reinterpret_cast<Cell*>(response_ + result.offset)};
    }
    bool first() const { return first_; }          // false when a long command is called again
    bool cancelling() const { return cancelling_; }  // last call of a long command that is cancelled
    // Why it failed, in words; returns Failed so that a handler can `return call.fail("…")`.
    Outcome fail(std::string_view why) CORTEX_REALTIME;
    std::string_view why() const { return why_.view(); }

    void setFirst(bool first) { first_ = first; }
    void setCancelling(bool cancelling) { cancelling_ = cancelling; }

private:
    const std::byte* request_;
    std::byte* response_;
    bool first_ = true;
    bool cancelling_ = false;
    EventText why_;
};

// A command handler bound to an object without std::function.
struct Handler {
    using Function = Outcome (*)(void* object, Call& call);
    void* object = nullptr;
    Function function = nullptr;

    Outcome operator()(Call& call) const { return function(object, call); }
};

// The commands of one type as the runtime sees them. `set`, built in, is the last one where the type
// has settable items: its request holds a presence flag per settable item, then the items.
struct CommandTable {
    struct Entry {
        const Command* command = nullptr;  // null for `set`
        std::string_view name;
        RecordLayout request, response;
        StateSet available;
    };
    std::vector<Entry> entries;
    std::vector<const DataItem*> settable;  // in the order of the flags
    std::uint32_t maxRequest = 0, maxResponse = 0;

    static constexpr std::uint32_t none = 0xffffffffU;
    std::uint32_t find(std::string_view command) const;
};

CommandTable commandTable(const Type& type);

// The three life-cycle commands bypass mailboxes: a pending word that is never full.
enum class LifeCycle : std::uint8_t { None, Startup, Shutdown, ClearFaults };
LifeCycle lifeCycleCommand(std::string_view command);

// Checks kinds' ranges (finite, min, max, enum labels where closed); "" if good, else the reason.
EventText checkArguments(const RecordLayout& layout, const std::byte* record) CORTEX_REALTIME;
void initialiseRecord(const RecordLayout& layout, std::byte* record);

}  // namespace cortex

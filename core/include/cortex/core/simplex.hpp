// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/mailbox.hpp"
#include "cortex/core/structure.hpp"
#include "cortex/core/type_model.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace cortex {

class Simplex;
class AgentRuntime;

// What a handle is asked for: refused where the item of the type is another.
struct ItemAccess {
    Kind kind;
    bool array, write;
    std::string_view unit{};  // UCUM, as the code assumes it; empty: any
    bool accepted = false;    // as it went out in the cycle before, of a demand
};

// What a simplex may touch of one that it is related to; got in populate(). Through an input data
// is read; through an output to a descriptive simplex it is written. Data of an active simplex is
// written by its own task only: read it as data<const T>, act on it with a command. Once the agent
// has started, data() and command() throw Error: a tick neither looks up names nor allocates.
class RelatedSimplex {
public:
    RelatedSimplex(Simplex& owner, std::uint32_t edge) : owner_{&owner}, edge_{edge} {}

    const std::string& path() const;
    const Type& type() const;
    const SlotState& state() const;  // as the owner sees it

    bool has(std::string_view item) const;
    // The object itself, to read; throws Error if it belongs to another agent.
    const Simplex& simplex() const;
    bool isDelayed() const;  // what is sent arrives in the next cycle
    bool isRemote() const;   // it belongs to another agent
    // What it is joined to itself under one of its rules of either direction, in order; what counts
    // for the rule by `refines` too. Structure only: a world learns which axes form a manipulator.
    // Of a simplex of another agent nothing is known, so it has none. Setup phase. Throws Error
    // where its type has no such rule.
    struct Joined {
        std::string path;
        const Type* type;
    };
    std::vector<Joined> related(std::string_view rule) const;

protected:
    void* cell(std::string_view item, const ItemAccess& access, std::size_t& length) const;
    const Value& safe(std::string_view item, const ItemAccess& access) const;
    CommandSender sender(std::string_view command, std::uint32_t capacity) const;
    const bool& isTaken() const;

    Simplex* owner_;
    std::uint32_t edge_;
};

[[noreturn]] void throwNoSuch(const Simplex& owner, std::string_view rule, std::size_t count,
                              std::size_t place);
[[noreturn]] void throwNotOne(const Simplex& owner, std::string_view rule, std::size_t count,
                              std::string_view all);

class InputSimplex : public RelatedSimplex {
public:
    using RelatedSimplex::RelatedSimplex;
    explicit InputSimplex(const RelatedSimplex& related) : RelatedSimplex{related} {}

    // `unit`: what the code assumes; it is refused where the type states another one.
    template <class T>
    Data<const T> data(std::string_view item, std::string_view unit = {}) const {
        std::size_t length = 1;
        return Data<const T>{static_cast<typename StorageOf<const T>::type*>(
            cell(item, {kindFor<T>(), false, false, unit}, length))};
    }
    template <class T>
    typename ArrayOf<const T>::type array(std::string_view item, std::string_view unit = {}) const {
        std::size_t length = 0;
        void* first = cell(item, {kindFor<T>(), true, false, unit}, length);
        return {static_cast<typename StorageOf<const T>::type*>(first), length};
    }
    // Of a demand, in populate(): the number that its type gives as safe, for a device whose
    // controller is not heard any more. Throws Error where that is hold, observed or missing.
    template <class T>
    T safeValue(std::string_view item, std::string_view unit = {}) const {
        return std::get<std::vector<T>>(safe(item, {kindFor<T>(), false, false, unit})).front();
    }
    // A command along this relationship; `capacity`: how many may be on their way at once. To a
    // simplex of another agent it has a second to arrive; then, or not heard, it is Expired.
    CommandSender command(std::string_view name, std::uint32_t capacity = 16) const {
        return sender(name, capacity);
    }
};

class OutputSimplex : public RelatedSimplex {
public:
    using RelatedSimplex::RelatedSimplex;

    template <class T>
    Data<T> data(std::string_view item, std::string_view unit = {}) const {
        std::size_t length = 1;
        return Data<T>{static_cast<typename StorageOf<T>::type*>(
            cell(item, {kindFor<T>(), false, !std::is_const_v<T>, unit}, length))};
    }
    template <class T>
    typename ArrayOf<T>::type array(std::string_view item, std::string_view unit = {}) const {
        std::size_t length = 0;
        void* first = cell(item, {kindFor<T>(), true, !std::is_const_v<T>, unit}, length);
        return {static_cast<typename StorageOf<T>::type*>(first), length};
    }
    // Of a demand, in hooks: the value that went out in the cycle before, after the choice among
    // its writers, its limits and safe values. Before the first start it is what a device sees.
    // data() is what this simplex wants alone; this is where every controller begins. It is no
    // input: no order of tasks follows. Throws Error where the target is no demand.
    template <class T>
    Data<const T> accepted(std::string_view item, std::string_view unit = {}) const {
        std::size_t length = 1;
        return Data<const T>{static_cast<typename StorageOf<const T>::type*>(
            cell(item, {kindFor<T>(), false, false, unit, true}, length))};
    }
    template <class T>
    typename ArrayOf<const T>::type acceptedArray(std::string_view item,
                                                  std::string_view unit = {}) const {
        std::size_t length = 0;
        void* first = cell(item, {kindFor<T>(), true, false, unit, true}, length);
        return {static_cast<typename StorageOf<const T>::type*>(first), length};
    }
    // Of a demand, in hooks, by the cycle before: false while each device of this agent that reads
    // it is away. Then a writer with a rate of its own stands, as one of the type does by itself.
    Data<const bool> taken() const { return Data<const bool>{&isTaken()}; }
    // Whether a start value was given for the item; see Simplex::hasValue().
    bool hasValue(std::string_view item) const;
    CommandSender command(std::string_view name, std::uint32_t capacity = 16) const {
        return sender(name, capacity);
    }
};

// What is related under one rule, in the order of the files.
template <class Related>
class RelatedList {
public:
    RelatedList(const Simplex& owner, std::string_view rule, std::vector<Related> all)
        : owner_{&owner}, rule_{rule}, all_{std::move(all)} {}

    std::size_t size() const { return all_.size(); }
    bool empty() const { return all_.empty(); }
    auto begin() { return all_.begin(); }
    auto end() { return all_.end(); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }
    operator const std::vector<Related>&() const { return all_; }
    // Throws Error, which names path, rule and count, where there are not so many.
    const Related& operator[](std::size_t place) const {
        if (place >= all_.size()) throwNoSuch(*owner_, rule_, all_.size(), place);
        return all_[place];
    }
    // The only one; throws Error where there are none or several. `all`: how one asks for them.
    const Related& only(std::string_view all) const {
        if (all_.size() != 1) throwNotOne(*owner_, rule_, all_.size(), all);
        return all_.front();
    }

private:
    const Simplex* owner_;
    std::string rule_;
    std::vector<Related> all_;
};

// The building block: <type, id, data, relationships, commands, mailbox>. The tree creates it; its
// data exists from start() on. A descriptive simplex needs no class of its own.
class Simplex {
public:
    struct Identity {
        std::string path;
        const Type* type;
    };
    struct Setting {
        std::string item;
        Value value;
        Place place;
    };
    struct Relation {
        std::string rule;
        std::string target;  // path
        bool delayed = false;
        bool remote = false;
        Place place;
        std::string type{};  // of a remote target; the rule's if empty
        double maxAge = 0;   // s, of an input; 0: the rule's
    };

    explicit Simplex(Identity identity);
    virtual ~Simplex();
    Simplex(const Simplex&) = delete;
    Simplex& operator=(const Simplex&) = delete;

    const std::string& path() const { return description_->identity.path; }
    const Type& type() const { return *description_->identity.type; }
    const std::vector<Relation>& relations() const { return description_->relations; }
    const std::vector<Setting>& settings() const { return description_->settings; }
    const Place& place() const { return description_->place; }
    int every() const { return description_->every; }
    int phase() const { return description_->phase; }
    std::uint32_t index() const { return index_; }  // in the Structure, from start() on
    // The whole object with its class; empty where it was not made by makeSimplex().
    std::span<const std::byte> object() const { return description_->object; }

    // Setup, before start(): the value an item starts with. Wrong ones are findings of validate().
    void set(std::string_view item, const GivenValue& value, Place place = {});
    void runEvery(int cycles, int phase = -1);

    // Own data, from populate() on; of a descriptive simplex without writer also for the program,
    // between cycles. Throws Error naming the nearest items if there is no such item, and where the
    // type states another unit than `unit`. What the framework writes is read only: data<const T>.
    template <class T>
    Data<T> data(std::string_view item, std::string_view unit = {}) {
        std::size_t length = 1;
        return Data<T>{static_cast<typename StorageOf<T>::type*>(
            cell(item, {kindFor<T>(), false, !std::is_const_v<T>, unit}, length))};
    }
    template <class T>
    typename ArrayOf<T>::type array(std::string_view item, std::string_view unit = {}) {
        std::size_t length = 0;
        void* first = cell(item, {kindFor<T>(), true, !std::is_const_v<T>, unit}, length);
        return {static_cast<typename StorageOf<T>::type*>(first), length};
    }
    // Whether the item starts with a value that a system file, another file, the command line or
    // the program gave. populate() must not replace that one. Throws Error for an unknown item.
    bool hasValue(std::string_view item) const;
    // Own quality and stamp, of a simplex without a task; of others the framework writes them, and
    // a hook says setQuality().
    SlotState& slot();

protected:
    // In populate(): what is related under a rule. input() and output() expect exactly one.
    InputSimplex input(std::string_view rule);
    OutputSimplex output(std::string_view rule);
    RelatedList<InputSimplex> inputs(std::string_view rule);
    RelatedList<OutputSimplex> outputs(std::string_view rule);

    template <class T>
    Argument<T> argument(std::string_view command, std::string_view name) const {
        return {parameter(command, name, {kindFor<T>(), false}, true).offset};
    }
    template <class T>
    Result<T> result(std::string_view command, std::string_view name) const {
        return {parameter(command, name, {kindFor<T>(), false}, false).offset};
    }
    template <ArrayElement T>
    ArrayArgument<T> arrayArgument(std::string_view command, std::string_view name) const {
        const ItemLayout& layout = parameter(command, name, {kindFor<T>(), true}, true);
        return {layout.offset, layout.item->length};
    }
    template <ArrayElement T>
    ArrayResult<T> arrayResult(std::string_view command, std::string_view name) const {
        const ItemLayout& layout = parameter(command, name, {kindFor<T>(), true}, false);
        return {layout.offset, layout.item->length};
    }
    void handle(std::string_view command, Handler handler);  // throws if the type lacks it
    AgentRuntime& runtime() const { return *runtime_; }      // from start() on

private:
    friend class AgentRuntime;
    friend class RelatedSimplex;
    friend class SimplexTree;
    template <class T, class... Arguments>
    friend std::unique_ptr<T> makeSimplex(Simplex::Identity identity, Arguments&&... arguments);

    AgentRuntime& startedRuntime() const;  // throws before start()
    void* cell(std::string_view item, const ItemAccess& access, std::size_t& length);
    struct Shape {
        Kind kind;
        bool array;
    };
    const ItemLayout& parameter(std::string_view command, std::string_view name, Shape shape,
                                bool request) const;
    std::vector<std::uint32_t> edgesUnder(std::string_view rule, Direction direction) const;

    // What the loop never looks at, so that what it does stands close together.
    struct Description {
        Identity identity;
        Place place{};
        std::vector<Relation> relations{};
        std::vector<Setting> settings{};
        int every = 1, phase = -1;
        std::span<const std::byte> object{};
    };

    std::unique_ptr<Description> description_;
    AgentRuntime* runtime_ = nullptr;
    std::uint32_t index_ = noSimplex;
};

template <class T, class... Arguments>
std::unique_ptr<T> makeSimplex(Simplex::Identity identity, Arguments&&... arguments) {
    auto made = std::make_unique<T>(std::move(identity), std::forward<Arguments>(arguments)...);
    made->Simplex::description_->object = std::as_bytes(std::span{made.get(), 1});
    return made;
}

}  // namespace cortex

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"
#include "cortex/core/state.hpp"
#include "cortex/core/type_model.hpp"

#include <QString>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What is known of all simplexes at one moment. A view gets it 30 times a second, on the thread of
// the window.
namespace cortex {
struct ItemLayout;
}
namespace cortex::gui {
struct Frame;  // of the window itself
}

namespace cortex::explorer {

// A simplex that was looked up once, in bind(). It says nothing any more after the next bind().
class Handle {
    friend class SimplexNow;
    friend class SystemNow;
    std::uint64_t structures_ = 0;
    std::uint32_t agent_ = ~std::uint32_t{0}, simplex_ = 0;
};

// The same of a number of it.
class Number {
    friend class SimplexNow;
    friend class SystemNow;
    std::uint64_t structures_ = 0;
    std::uint32_t agent_ = ~std::uint32_t{0}, simplex_ = 0;
    const ItemLayout* item_ = nullptr;
    std::size_t element_ = 0;
};

// What is known of one simplex at one moment. Valid until the call ends that it was given to.
class SimplexNow {
public:
    SimplexNow(const gui::Frame& frame, std::string_view path);
    SimplexNow(const gui::Frame& frame, const Handle& handle);

    bool present() const { return agent_ != none; }  // whether an agent with it was heard of
    const Type* type() const;                        // null: not present
    std::optional<State> state() const;              // none: it has none, or it was not heard
    Quality quality() const;                         // `Lost` where nothing is known
    std::optional<double> age() const;               // s; none: no values ever came
    // What it writes is the present value: it is good, or a safe demand, and its agent is heard.
    // Otherwise values are the last ones; but what the framework writes, as its state, is present.
    bool live() const;
    // None: there is no such item or element, it is no number, or it never came. A constant is
    // there as soon as the simplex is known.
    std::optional<double> number(std::string_view item, std::size_t element = 0) const;
    // As the window shows it: with label; in brackets if it is not present; "—" if it never came.
    QString text(std::string_view item, std::size_t element = 0) const;
    QString unit(std::string_view item) const;  // typeset: "m/s²"
    // What its type allows: the least and the greatest value, and the greatest change in a second.
    // None: without such a limit.
    std::optional<double> min(std::string_view item) const;
    std::optional<double> max(std::string_view item) const;
    std::optional<double> rate(std::string_view item) const;
    // Paths of what it names under this rule, in their order, and of who names it under this rule.
    std::vector<std::string> related(std::string_view rule) const;
    std::vector<std::string> relatedBy(std::string_view rule) const;

    Handle handle() const;
    Number find(std::string_view item, std::size_t element = 0) const;

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    const DataItem* data(std::string_view item) const;

    const gui::Frame* frame_;
    std::uint32_t agent_ = none, simplex_ = 0;
};

// One moment of everything. Valid until the call ends that it was given to.
class SystemNow {
public:
    explicit SystemNow(const gui::Frame& frame) : frame_{&frame} {}

    std::uint64_t moment() const;  // its number; grows with each one
    std::int64_t utc() const;      // ns, by this computer's clock
    SimplexNow at(std::string_view path) const { return {*frame_, path}; }
    SimplexNow at(const Handle& handle) const { return {*frame_, handle}; }
    std::optional<double> number(const Number& number) const;         // as SimplexNow::number()
    std::vector<std::string> instances(std::string_view type) const;  // and of its children; sorted
    // The device that acts on this demand or observation: who names it under `demand`, `demands`,
    // `observation` or `observations`. None: nobody who is heard.
    std::optional<std::string> deviceOf(std::string_view path) const;

private:
    const gui::Frame* frame_;
};

}  // namespace cortex::explorer

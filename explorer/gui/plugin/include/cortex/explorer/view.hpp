// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"
#include "cortex/core/state.hpp"
#include "cortex/core/type_model.hpp"

#include <QString>
#include <QWidget>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What a view of one's own for `cortex-explorer` needs: docs/own-views.md. All of it is used on the
// thread of the window only, and waits for nothing.
namespace cortex::explorer {

struct Frame;

// What is known of one simplex at one moment. Valid until the call ends that it was given to.
class SimplexNow {
public:
    SimplexNow(const Frame& frame, std::string_view path);

    bool present() const { return agent_ != none; }  // whether an agent with it was heard of
    const Type* type() const;                        // null: not present
    std::optional<State> state() const;              // none: it has none, or it was not heard
    Quality quality() const;                         // `Lost` where nothing is known
    std::optional<double> age() const;               // s; none: no values ever came
    bool live() const;  // good, and its agent is heard: otherwise values are the last ones
    // None: there is no such item or element, it is no number, or it never came.
    std::optional<double> number(std::string_view item, std::size_t element = 0) const;
    // As the window shows it: with label; in brackets if it is not live; "—" if it never came.
    QString text(std::string_view item, std::size_t element = 0) const;
    QString unit(std::string_view item) const;  // typeset: "m/s²"
    // The least and the greatest value that its type allows; none: without such a limit.
    std::optional<double> min(std::string_view item) const;
    std::optional<double> max(std::string_view item) const;
    // Paths of what it names under this rule, in their order, and of who names it under this rule.
    std::vector<std::string> related(std::string_view rule) const;
    std::vector<std::string> relatedBy(std::string_view rule) const;

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    const DataItem* data(std::string_view item) const;

    const Frame* frame_;
    std::uint32_t agent_ = none, simplex_ = 0;
};

// One moment of everything. Valid until the call ends that it was given to.
class SystemNow {
public:
    explicit SystemNow(const Frame& frame) : frame_{&frame} {}
    SimplexNow at(std::string_view path) const { return {*frame_, path}; }
    std::vector<std::string> instances(std::string_view type) const;  // and of its children; sorted

private:
    const Frame* frame_;
};

// A view of one simplex. What its functions throw is shown in its place, and it is closed.
class View : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;
    // Once at first, and whenever agents, simplexes or types came or went.
    virtual void bind(const SystemNow& now);
    // About 30 times a second while it is visible: at most 2 ms.
    virtual void refresh(const SystemNow& now) = 0;

Q_SIGNALS:
    void opened(const std::string& path);  // show this simplex instead
};

// One kind of view: for all simplexes of a type and its children, unless a child has one of its
// own.
struct ViewType {
    const char* name;     // "oven-overview"; unique
    const char* title;    // of its tab: "Overview"
    const char* forType;  // "Oven"
    View* (*make)(const std::string& path);
};

// What a shared object offers. A window refuses one that was built for another number.
struct Plugin {
    static constexpr std::uint32_t current = 1;
    std::uint32_t api = current;
    const ViewType* views = nullptr;
    std::size_t count = 0;
};

// CORTEX_EXPLORER_PLUGIN({"oven-overview", "Overview", "Oven", &makeOvenView}, …)
#define CORTEX_EXPLORER_PLUGIN(...)                                                            \
    extern "C" __attribute__((visibility("default"))) const cortex::explorer::Plugin*          \
    cortexExplorerPlugin() {                                                                   \
        static const cortex::explorer::ViewType views[] = {__VA_ARGS__};                       \
        static const cortex::explorer::Plugin plugin{cortex::explorer::Plugin::current, views, \
                                                     sizeof views / sizeof views[0]};          \
        return &plugin;                                                                        \
    }

}  // namespace cortex::explorer

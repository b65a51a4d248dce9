// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/program_interface.hpp"
#include "cortex/explorer/now.hpp"

#include <QJsonObject>
#include <QString>
#include <QWidget>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

// What a view of one's own for `cortex-explorer` needs: docs/own-views.md. All of it is used on the
// thread of the window only, and waits for nothing.
namespace cortex::explorer {

using Arguments = ProgramInterface::Arguments;

// Simplexes whose values are wanted, at and below these paths.
struct Watch {
    std::vector<std::string> prefixes;
    std::uint32_t rate = 30;  // Hz: 5, 30, 100; 0: in every cycle of their agent
};

struct Order {
    std::string path, command;
    Arguments arguments{};
    // It expires if its agent has not read it within this time.
    std::chrono::milliseconds budget = std::chrono::seconds{5};
};

// What became of an order.
struct Answer {
    bool done = false;
    QString text;                           // in words, for people: "Done  1.9 ms, 2 cycles"
    std::map<std::string, Value> values{};  // that the command gave, by name
};

// An order that is repeated while something is held down, such as the jog of an axis.
struct HeldOrder {
    Order order;  // with a budget of about three repetitions, so that a late one moves nothing
    std::chrono::milliseconds every{100};
    std::optional<Arguments> atEnd{};  // the same command, once, when it ends
};

// An order that is being repeated. It ends with this object, and by itself when the button is let
// go, hidden or disabled, moves away from under the pointer, its window is resized, the keyboard's
// focus or the program's leaves it, another key or button is pressed, control is lost, an answer is
// no success or takes longer than the budget, or the window's thread hangs.
class Hold : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    virtual bool runs() const = 0;
    virtual QString why() const = 0;  // it ended: "let go", "focus left", …; empty: it runs
    virtual void change(const Arguments& arguments) = 0;  // of the next repetition on
    virtual void end() = 0;

Q_SIGNALS:
    void ended();  // once; why() says why
};

// The unit in which a number is shown, as the user has chosen it for the page of the view.
struct ShownUnit {
    QString text;       // typeset: "°/s"
    double factor = 1;  // from the number of the model to the shown one
};

// What the window does for a view.
class Host {
public:
    using Done = std::function<void(const Answer&)>;
    virtual ~Host() = default;
    virtual QString whyNot(const std::string& path, const std::string& command) const = 0;
    virtual void send(QWidget& asker, const Order& order, Done done) = 0;
    virtual Hold* hold(QWidget& button, const HeldOrder& order) = 0;
    virtual ShownUnit shownUnit(const QWidget& asker, const std::string& unit) const;
    virtual void chooseUnit(QWidget& asker, const std::string& unit);
};

// A view of one simplex, or of the whole system. What its functions throw is shown in its place,
// and it is closed.
class View : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;
    // Once at first, and whenever agents, simplexes or types came or went.
    virtual void bind(const SystemNow& now);
    // About 30 times a second while it is visible: at most 2 ms.
    virtual void refresh(const SystemNow& now) = 0;
    // What it shows; asked again after bind(). None: the window chooses.
    virtual std::vector<Watch> watches() const { return {}; }
    // Whether it has drawn what it knows: a picture for a file waits for that.
    virtual bool settled() const { return true; }
    // The user chose this simplex elsewhere. True: the view shows where it is, so that the window
    // stays with it.
    virtual bool select(const std::string& path);
    // What a layout keeps of it, and gets back in another session.
    virtual QJsonObject saved() const { return {}; }
    virtual void restore(const QJsonObject& saved);
    void setHost(Host* host) { host_ = host; }  // by the window

Q_SIGNALS:
    void opened(const std::string& path);    // show this simplex instead
    void selected(const std::string& path);  // mark it in the tree; the view stays

protected:
    // Why this cannot be sent now, in words for a label at the button: "needs Standby". Empty: it
    // can be.
    QString whyNot(const std::string& path, const std::string& command) const;
    // Sends an order. Where it needs control, the window offers to take it, and where its type asks
    // for it, the window asks the user first. `done` is called once, unless the view is gone.
    void send(const Order& order, Host::Done done = {});
    // Repeats an order until the button is let go. Belongs to the button.
    Hold* hold(QWidget& button, const HeldOrder& order);
    // How the page shows what has this unit in the model (UCUM, as types write it): "rad/s".
    ShownUnit shownUnit(const std::string& unit) const;
    // Shows angles or lengths in this unit from now on: "rad", "deg", "m", "mm".
    void chooseUnit(const std::string& unit);

private:
    Host* host_ = nullptr;
};

// One kind of view: for all simplexes of a type and its children, unless a child has one of its
// own. For no type (""): of the whole system, in a tab of its own; its path is empty.
struct ViewType {
    const char* name;     // "oven-overview"; unique
    const char* title;    // of its tab: "Overview"
    const char* forType;  // "Oven"
    View* (*make)(const std::string& path);
};

// What a shared object offers. A window refuses one that was built for another number.
struct Plugin {
    static constexpr std::uint32_t current = 2;
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

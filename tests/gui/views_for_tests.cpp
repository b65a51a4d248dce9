// SPDX-License-Identifier: Apache-2.0
// Views that the tests of the window load.
#include "cortex/explorer/view.hpp"

#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QVBoxLayout>
#include <initializer_list>
#include <stdexcept>

using namespace cortex::explorer;

namespace {

// Says what it knows, as text.
class SaysAll final : public View {
public:
    explicit SaysAll(std::string path) : path_{std::move(path)}, label_{new QLabel{this}} {
        label_->setObjectName("said");
    }
    void bind(const SystemNow& now) override {
        demands_ = now.at(path_).related("demand");
        controllers_ = now.at(demands_.at(0)).relatedBy("demands");
        devices_ = now.instances("AxisDevice");
    }
    void refresh(const SystemNow& now) override {
        const SimplexNow device = now.at(path_), axis = now.at(demands_.at(0));
        QStringList said{axis.text("position") + axis.unit("position"),
                         device.live() ? "live" : "not live",
                         device.state() ? name(*device.state()) : "no state"};
        said << QString::number(controllers_.size()) << QString::fromStdString(devices_.at(0));
        said << now.at("/nobody").text("position") << device.text("no such item");
        label_->setText(said.join('|'));
    }

private:
    std::string path_;
    QLabel* label_;
    std::vector<std::string> demands_, controllers_, devices_;
};

// Looks its numbers up once, and names the device of what it shows.
class Looks final : public View {
public:
    explicit Looks(std::string path) : path_{std::move(path)}, label_{new QLabel{this}} {
        label_->setObjectName("said");
    }
    void bind(const SystemNow& now) override {
        stale_ = position_;
        position_ = now.at(path_).find("position");
        simplex_ = now.at(path_).handle();
    }
    void refresh(const SystemNow& now) override {
        const auto moment = now.moment();
        const QString order = moment > moment_ && now.utc() > 0 ? "later" : "not later";
        moment_ = moment;
        const QStringList said{QString::number(now.number(position_).value_or(-1)),
                               QString::number(now.at(simplex_).max("position").value_or(-1)),
                               QString::number(now.at(simplex_).rate("position").value_or(-1)),
                               QString::fromStdString(now.deviceOf(path_).value_or("nobody")),
                               now.number(stale_) ? "stale" : "none",
                               selected_ + order};
        label_->setText(said.join('|'));
    }
    bool select(const std::string& path) override {
        selected_ = QString::fromStdString(path) + ' ';
        return true;
    }

private:
    std::string path_;
    QLabel* label_;
    QString selected_;
    Number position_, stale_;
    Handle simplex_;
    std::uint64_t moment_ = 0;
};

// Sends when it is told to, and jogs while its button is down.
class Orders final : public View {
public:
    explicit Orders(std::string path) : path_{std::move(path)} {
        auto* rows = new QVBoxLayout{this};
        auto *send = new QPushButton{"send"}, *jog = new QPushButton{"jog"};
        said_->setObjectName("said");
        for (QWidget* each : std::initializer_list<QWidget*>{send, jog, said_, held_}) {
            rows->addWidget(each);
        }
        send->setObjectName("send");
        jog->setObjectName("jog");
        held_->setObjectName("held");
        connect(send, &QPushButton::clicked, this, [this] {
            this->send({path_, "set", {{"holdTime", 0.2}}},
                       [this](const Answer& answer) { said_->setText(answer.text); });
        });
        connect(jog, &QPushButton::pressed, this, [this, jog] {
            const Arguments still{{"axis", std::int64_t{1}}, {"velocity", 0.0}};
            const Arguments moving{{"axis", std::int64_t{1}}, {"velocity", 0.1}};
            hold_ = hold(*jog, {{path_, "jog", moving, std::chrono::seconds{1}},
                                std::chrono::milliseconds{50},
                                still});
        });
    }
    void refresh(const SystemNow& /*now*/) override {
        if (hold_) held_->setText(hold_->runs() ? "runs" : hold_->why());
    }

private:
    std::string path_;
    QLabel *said_ = new QLabel, *held_ = new QLabel;
    QPointer<Hold> hold_;
};

class Throws final : public View {
public:
    void refresh(const SystemNow& /*now*/) override { throw std::runtime_error{"out of paper"}; }
};

View* makeSaysAll(const std::string& path) { return new SaysAll{path}; }
View* makeLooks(const std::string& /*path*/) { return new Looks{"/axis/demanded"}; }
View* makeOrders(const std::string& path) { return new Orders{path}; }
View* makeThrows(const std::string& /*path*/) { return new Throws; }
View* makeNothing(const std::string& /*path*/) { return nullptr; }

}  // namespace

CORTEX_EXPLORER_PLUGIN({"says-all", "All", "AxisDevice", &makeSaysAll},
                       {"looks", "Looks", "", &makeLooks},
                       {"orders", "Orders", "JogController", &makeOrders},
                       {"throws", "Paper", "HoldAxisController", &makeThrows},
                       {"nothing", "Nothing", "Active", &makeNothing})

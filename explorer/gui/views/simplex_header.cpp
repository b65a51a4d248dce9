// SPDX-License-Identifier: Apache-2.0
#include "views/simplex_header.hpp"

#include "common/role_meaning.hpp"
#include "model/fault_text.hpp"
#include "model/gone_text.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "model/why_text.hpp"
#include "widgets/link.hpp"
#include "widgets/state_mark.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

namespace cortex::gui {

namespace {

// Its first parent, the first parent of that, and so on.
std::vector<std::string> chainOf(const Type& type, const TypeModel& types) {
    std::vector<std::string> names;
    for (const Type* each = &type; each != nullptr && !each->parents.empty();) {
        names.push_back(each->parents.front());
        each = types.find(each->parents.front());
    }
    return names;
}

constexpr std::array widestAges{0.999, 99.9, 99.0 * 60};  // s, of ms, seconds, minutes

int widthOf(const QString& text, const QFont& font) {
    return QFontMetrics{font}.horizontalAdvance(text) + 2;
}

}  // namespace

SimplexHeader::SimplexHeader(QWidget* lifeCycle, const StateTimes& times, QWidget* parent)
    : QWidget{parent},
      times_{times},
      lifeCycle_{lifeCycle},
      mark_{new StateMark{8}},
      state_{new TextLabel{TextSize::Title, true}},
      since_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      outcome_{new TextLabel{TextSize::Text}},
      path_{new TextLabel{TextSize::Title, true}},
      type_{new TextLabel{TextSize::Text}},
      ancestors_{new QWidget},
      agent_{new TextLabel{TextSize::Text}},
      quality_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      task_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      messages_{new MessageArea},
      dismiss_{new QPushButton{tr("Dismiss")}} {
    state_->keepWhole();
    quality_->keepWhole();
    path_->keepEnd();
    new QHBoxLayout{ancestors_};
    ancestors_->layout()->setContentsMargins(0, 0, 0, 0);
    ancestors_->layout()->setSpacing(Look::units(1));
    dismiss_->setToolTip(tr("Takes the agent out of tree, counters and status line."));
    dismiss_->hide();
    connect(dismiss_, &QPushButton::clicked, this,
            [this] { Q_EMIT dismissed(agentName_.toStdString()); });
    connect(messages_, &MessageArea::pressed, this, [this] {
        if (fault_) Q_EMIT beforeWanted(*fault_);
    });
    layOut();
}

void SimplexHeader::layOut() {
    rows_ = new QVBoxLayout{this};
    rows_->setContentsMargins(0, 0, 0, 0);
    rows_->setSpacing(Look::units(2));
    states_ = new QVBoxLayout;
    states_->setSpacing(0);
    title_ = new QVBoxLayout;
    title_->setSpacing(0);
    for (QWidget* each : {state_, since_, outcome_}) title_->addWidget(each, 0, Qt::AlignLeft);
    states_->addLayout(title_);
    states_->addStretch(1);
    auto* state = new QHBoxLayout;
    state->setSpacing(Look::units(3));
    state->addWidget(mark_, 0, Qt::AlignTop);
    state->addLayout(states_, 1);
    first_ = new QHBoxLayout;
    first_->addLayout(state, 1);
    first_->addWidget(lifeCycle_, 0, Qt::AlignTop);

    auto* names = new QHBoxLayout;
    names->setSpacing(Look::units(3));
    for (QWidget* each : std::initializer_list<QWidget*>{path_, type_, ancestors_}) {
        names->addWidget(each);
    }
    names->addStretch(1);
    auto* facts = new QHBoxLayout;
    facts->setSpacing(Look::units(3));
    for (QWidget* each : {agent_, quality_, task_}) facts->addWidget(each);
    facts->addStretch(1);
    second_ = new QHBoxLayout;
    second_->setSpacing(Look::units(1));
    second_->addLayout(names, 1);
    second_->addLayout(facts);

    auto* last = new QHBoxLayout;
    last->addWidget(messages_, 1);
    last->addWidget(dismiss_, 0, Qt::AlignTop);
    rows_->addLayout(first_);
    rows_->addLayout(second_);
    rows_->addLayout(last);
}

// Below the state, beside the buttons of the life cycle; or in a row of their own.
void SimplexHeader::placeNames(bool beside) {
    QBoxLayout* place = beside ? states_ : rows_;
    auto* now = static_cast<QBoxLayout*>(second_->parent());
    if (now == place) return;
    now->removeItem(second_);
    second_->setParent(nullptr);
    place->insertLayout(1, second_);
}

// The room of a text is that of the longest one that may stand there, so that what comes with time
// changes no row.
SimplexHeader::Room SimplexHeader::room() const {
    const auto wide = [](const QWidget& each) {
        return each.isHidden() ? 0 : each.sizeHint().width() + Look::units(3);
    };
    const auto longest = [&](const TextLabel& label, const QStringList& texts) {
        int width = wide(label);
        for (const QString& each : texts) {
            const int needed = widthOf(each, label.font()) + Look::units(3);
            if (!label.isHidden()) width = std::max(width, needed);
        }
        return width;
    };
    Room room;
    QStringList states;
    if (hasStates_) {
        for (const Shape each : {Shape::Standby, Shape::Active, Shape::Fault, Shape::Unknown})
            states << bracketed(word(each));
        for (const Shape each : {Shape::StartingUp, Shape::ShuttingDown}) states << word(each);
    }
    room.mark = wide(*mark_);
    room.state = longest(*state_, states);
    const int since = widthOf(times_.longest(), since_->font()) + Look::units(3);
    room.since = hasStates_ ? std::max(since, since_->sizeHint().width()) : 0;
    room.buttons = wide(*lifeCycle_);
    room.names = wide(*path_) + wide(*type_);
    QStringList ages;
    for (const double seconds : widestAges) ages << factsOf(agentName_, ageText(seconds));
    room.facts = longest(*agent_, ages) +
                 longest(*quality_, {restText(false), tr("input lost"), waitingText()}) + taskWide_;
    return room;
}

// What gives way in a small window: ancestors, then the agent and the buttons take lines of their
// own; in a low one the name of the type goes. State, quality and buttons are never cut.
void SimplexHeader::fit() {
    const bool low = Look::isLow(*this);
    const TextSize title = low ? TextSize::Value : TextSize::Title;
    path_->setTextSize(title, true);
    state_->setTextSize(hasWord_ ? title : TextSize::Text, hasWord_);
    mark_->setUnits(!hasWord_ ? 4 : low ? 6 : 8);
    const bool hasTask = !brief_ && !low;  // it stands among the data, too
    taskWide_ = hasTask ? std::max(taskWide_, task_->sizeHint().width() + Look::units(3)) : 0;
    task_->setVisible(hasTask);
    type_->setVisible(true);
    const Room room = this->room();
    const bool flat = brief_ || low;
    const int state = room.mark + (flat ? room.state : std::max(room.state, room.since));
    const bool one = state + room.buttons <= width();
    const int beside = width() - room.mark - (one ? room.buttons : 0);  // for state and outcome
    const int line = room.state + room.since;
    const bool brief = brief_ && one && std::max({room.names, room.facts, line}) <= beside;
    placeNames(brief);
    placeState(one, flat, beside - line);
    const int whole = brief ? beside : width();
    const bool fits = room.names + room.facts <= whole;
    second_->setDirection(fits || low ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    type_->setVisible(fits || !low);
    const int chain = ancestors_->sizeHint().width() + Look::units(3);
    const int others = room.names + (fits ? room.facts : 0);
    ancestors_->setVisible(!flat && others + chain <= width());
    const int gap = Look::units(flat ? 0.5 : 2);
    if (rows_->spacing() != gap) rows_->setSpacing(gap);
    const int between = brief ? Look::units(4) : gap;
    if (first_->spacing() != between) first_->setSpacing(between);
    messages_->setRoom(brief_ && !low ? 1 : 2, low ? TextSize::Note : TextSize::Text);
    dismiss_->setFixedHeight(std::min(Look::units(7), messages_->sizeHint().height()));
    // A request to lay it out is lost while it is hidden, and then none is made any more.
    layout()->activate();
}

// State, since when and outcome: below one another, or in one line where they stand beside nothing
// or there is little height. There the time gives way.
void SimplexHeader::placeState(bool one, bool flat, int left) {
    const bool below = one && !flat;
    title_->setDirection(below ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    title_->setSpacing(below ? 0 : Look::units(3));
    title_->setStretchFactor(outcome_, flat ? 1 : 0);
    title_->setAlignment(since_, below ? Qt::AlignLeft : Qt::AlignLeft | Qt::AlignVCenter);
    title_->setAlignment(outcome_, below ? Qt::AlignLeft : Qt::AlignRight | Qt::AlignVCenter);
    first_->setDirection(one ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    first_->setAlignment(lifeCycle_, one ? Qt::AlignTop : Qt::AlignTop | Qt::AlignLeft);
    const QString outcome = outcome_->isHidden() ? QString{} : outcome_->text();
    const int needed = outcome.isEmpty() ? 0 : widthOf(outcome, outcome_->font());
    since_->setVisible(hasStates_ && (!flat || needed <= left));
    if (hasWord_) state_->explain(since_->isHidden() ? since_->text() : QString{});
}

void SimplexHeader::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fit();
}

void SimplexHeader::show(const Frame& frame, Place place) {
    const Type& type = frame.type(place);
    const QString path = QString::fromStdString(frame.info(place).path);
    if (path != path_->text()) taskWide_ = 0;
    path_->show(path);
    type_->show(QString::fromStdString(type.name));
    path_->explain(type_->text());
    description_ = QString::fromStdString(type.description);
    qDeleteAll(ancestors_->findChildren<QWidget*>(QString{}, Qt::FindDirectChildrenOnly));
    QStringList names;
    for (const std::string& each : chainOf(type, *frame.agents[place.agent].structure->types)) {
        auto* before = new TextLabel{TextSize::Text, false, &Tokens::ink2};
        before->show(QStringLiteral("‹"));
        auto* link = new Link{QString::fromStdString(each)};
        connect(link, &Link::clicked, this, [this, each] { Q_EMIT typeWanted(each); });
        ancestors_->layout()->addWidget(before);
        ancestors_->layout()->addWidget(link);
        names << QString::fromStdString(each);
    }
    type_->explain(names.join(QStringLiteral(" ‹ ")));
    refresh(frame, place);
}

// It has room of its own, so that nothing moves when it comes or goes.
void SimplexHeader::tell(const QString& outcome) { outcome_->show(outcome); }

void SimplexHeader::refresh(const Frame& frame, Place place) {
    refreshState(frame, place);
    refreshAgent(frame, place);
    QStringList why{whyText(frame, place), goneInputText(frame, place)};
    why.removeAll({});
    const bool low = Look::isLow(*this);
    messages_->show({fault(frame, place),
                     notice(frame, place),
                     {low ? outcome_->text() : QString{}, &Tokens::ink},
                     {why.join(' ')},
                     {low ? reasons_ : description_}});
    fit();
    // It may need another height now; what is around it is not laid out just now.
    if (parentWidget() != nullptr && parentWidget()->layout() != nullptr) {
        parentWidget()->layout()->activate();
    }
}

void SimplexHeader::refreshState(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    const Type& type = frame.type(place);
    hasStates_ = type.active() && !type.isA("Agent");
    hasWord_ = type.active();
    outcome_->setVisible(hasStates_ && !Look::isLow(*this));  // it stands among the messages there
    since_->show(hasStates_ && !agent.lost() ? times_.text(frame, place) : QString{});
    if (type.isA("Agent")) {  // it has commands, but no state of its own
        mark_->show(agent.status.ended ? Shape::Ended : agent.lost() ? Shape::Lost : Shape::Agent);
        state_->show(agent.status.ended ? tr("ended") : QString::fromStdString(agent.status.state),
                     &Tokens::ink);
        return;
    }
    if (!hasStates_) {
        mark_->show(Shape::Data);
        showRole(frame.info(place).role);
        return;
    }
    const auto state = agent.state(place.simplex), last = agent.lastState(place.simplex);
    const Shape shape = state ? shapeOf(*state) : Shape::Unknown;
    const bool faulted = shape == Shape::Fault;
    mark_->show(shape);
    const QString now = faulted ? word(shape) + faultCode(agent, place.simplex) : word(shape);
    state_->show(!state && last ? bracketed(word(shapeOf(*last))) : now,
                 faulted ? &Tokens::faultText : &Tokens::ink);
}

// Data have no state: what they are stands there, no larger than the rest. The meaning gives way.
void SimplexHeader::showRole(Role role) {
    state_->setTextSize(TextSize::Text, false);
    const QString word{QLatin1String{name(role)}};
    const QString meaning = tr(std::string{common::roleMeaning(role)}.c_str());
    const QString whole = meaning.isEmpty() ? word : tr("%1: %2").arg(word, meaning);
    const int room = width() - mark_->sizeHint().width() - Look::units(6);
    state_->show(widthOf(whole, state_->font()) <= room ? whole : word, &Tokens::ink2);
    state_->explain(tr("%1. It has no state and no task of its own.").arg(whole));
}

// Where its event is known, the text opens what was before it.
MessageArea::Message SimplexHeader::fault(const Frame& frame, Place place) {
    fault_.reset();
    if (frame.agents[place.agent].state(place.simplex) != State::Fault) return {};
    const FaultText fault = faultText(frame, place, times_);
    fault_ = times_.faultEvent(frame, place);
    return {fault.text, fault_ ? &Tokens::accent : &Tokens::ink, true,
            fault.cut ? tr("The rest stands in the events.") : QString{},
            fault_ ? tr("Ten seconds before") : QString{}};
}

MessageArea::Message SimplexHeader::notice(const Frame& frame, Place place) const {
    const AgentFrame& agent = frame.agents[place.agent];
    QString notice = claimsText(frame, place, times_);
    QColor Tokens::* colour = &Tokens::warnText;
    if (agent.lost()) {
        const GoneAgent* gone = frame.goneFrom(frame.info(place).path);
        const QString ended =
            gone != nullptr ? goneText(*gone) : tr("%1 has ended.").arg(agentName_);
        notice = agent.status.ended
                     ? tr("%1 Values are the last ones, in brackets.").arg(ended)
                     : tr("%1 is not heard for %2. Values are the last ones, in brackets.")
                           .arg(agentName_, ageText(agent.status.age));
        colour = agent.status.ended ? &Tokens::ink : &Tokens::dataText;
    } else if (!agent.status.standstill.empty()) {
        notice = tr("%1 %2. Values are the last ones, in brackets.")
                     .arg(agentName_, QString::fromStdString(agent.status.standstill));
        colour = &Tokens::dataText;
    }
    return {notice, colour, true};
}

}  // namespace cortex::gui

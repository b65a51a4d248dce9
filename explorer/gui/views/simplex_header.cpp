// SPDX-License-Identifier: Apache-2.0
#include "views/simplex_header.hpp"

#include "model/fault_text.hpp"
#include "model/gone_text.hpp"
#include "model/item_of.hpp"
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

// Nothing of it changes by itself, so that its age says nothing.
bool neverChanges(const SimplexInfo& info) {
    return info.role != Role::Active && info.writers.empty();
}

// "task 2.3 µs of 1 ms".
QString taskText(const AgentFrame& agent, std::uint32_t simplex) {
    const auto time = itemOf<double>(agent, simplex, "taskTime");
    if (!time || agent.lost()) return {};
    const double period =
        static_cast<double>(agent.status.period) * agent.structure->simplexes[simplex].every;  // ns
    return SimplexHeader::tr("task %1 µs of %2 ms")
        .arg(*time, 0, 'f', 1)
        .arg(period * 1e-6, 0, 'g', 4);
}

TextLabel* wrapped(TextSize size, bool strong, QColor Tokens::* colour) {
    auto* label = new TextLabel{size, strong, colour};
    label->setWordWrap(true);
    label->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Minimum);
    label->hide();
    return label;
}

void showOrHide(TextLabel& label, const QString& text) {
    label.show(text);
    label.setVisible(!text.isEmpty());
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
      fault_{wrapped(TextSize::Text, true, &Tokens::ink)},
      path_{new TextLabel{TextSize::Title, true}},
      type_{new TextLabel{TextSize::Text}},
      ancestors_{new QWidget},
      agent_{new TextLabel{TextSize::Text}},
      quality_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      task_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      description_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      why_{wrapped(TextSize::Text, false, &Tokens::ink2)},
      notice_{wrapped(TextSize::Text, true, &Tokens::dataText)},
      dismiss_{new QPushButton{tr("Dismiss")}} {
    state_->keepWhole();
    quality_->keepWhole();
    new QHBoxLayout{ancestors_};
    ancestors_->layout()->setContentsMargins(0, 0, 0, 0);
    ancestors_->layout()->setSpacing(Look::units(1));
    dismiss_->setToolTip(tr("Takes the agent out of tree, counters and status line."));
    dismiss_->hide();
    connect(dismiss_, &QPushButton::clicked, this, [this] { Q_EMIT dismissed(agentName_); });
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
    states_->addWidget(fault_);
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

    auto* notices = new QHBoxLayout;
    notices->addWidget(notice_, 1);
    notices->addWidget(dismiss_, 0, Qt::AlignTop);
    rows_->addLayout(first_);
    rows_->addLayout(second_);
    rows_->addWidget(description_);
    rows_->addWidget(why_);
    rows_->addLayout(notices);
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

// What gives way in a small window: ancestors and description, then the agent and the buttons take
// lines of their own. State, quality and buttons are never cut.
void SimplexHeader::fit() {
    const auto wide = [](const QWidget& each) {
        return each.isHidden() ? 0 : each.sizeHint().width() + Look::units(3);
    };
    const int state = wide(*mark_) + std::max(wide(*state_), wide(*since_));
    const bool one = state + wide(*lifeCycle_) <= width();
    first_->setDirection(one ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    const int names = wide(*path_) + wide(*type_);
    if (brief_) task_->hide();  // it stands among the data
    const int facts = wide(*agent_) + wide(*quality_) + wide(*task_);
    const int room = width() - wide(*lifeCycle_) - wide(*mark_);  // beside the buttons
    const int line = wide(*state_) + wide(*since_);
    const bool brief = brief_ && one && std::max({names, facts, line}) <= room;
    placeNames(brief);
    // What became of a command has no line of its own then: it takes the place of the time.
    if (brief && !outcome_->text().isEmpty() && line + wide(*outcome_) > room) since_->hide();
    const bool below = one && !brief;
    title_->setDirection(below ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    title_->setSpacing(below ? 0 : Look::units(3));
    title_->setStretchFactor(outcome_, brief ? 1 : 0);
    title_->setAlignment(since_, below ? Qt::AlignLeft : Qt::AlignLeft | Qt::AlignVCenter);
    title_->setAlignment(outcome_, below ? Qt::AlignLeft : Qt::AlignRight | Qt::AlignVCenter);
    first_->setAlignment(lifeCycle_, one ? Qt::AlignTop : Qt::AlignTop | Qt::AlignLeft);
    const int chain = ancestors_->sizeHint().width() + Look::units(3);
    const bool beside = names + facts <= (brief ? room : width());
    second_->setDirection(beside ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    const bool low = brief_ || window()->height() < Look::units(175);
    ancestors_->setVisible(!low && names + chain + (beside ? facts : 0) <= width());
    description_->setVisible(!low && !description_->text().isEmpty());
    const int gap = Look::units(low ? 0.5 : 2);
    if (rows_->spacing() != gap) rows_->setSpacing(gap);
    const int between = brief ? Look::units(4) : gap;
    if (first_->spacing() != between) first_->setSpacing(between);
    // A request to lay it out is lost while it is hidden, and then none is made any more.
    layout()->activate();
}

void SimplexHeader::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fit();
}

void SimplexHeader::show(const Frame& frame, Place place) {
    const Type& type = frame.type(place);
    path_->show(QString::fromStdString(frame.info(place).path));
    type_->show(QString::fromStdString(type.name));
    description_->show(QString::fromStdString(type.description));
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
    type_->setToolTip(tipText(names.join(QStringLiteral(" ‹ "))));
    refresh(frame, place);
}

// It has room of its own, so that nothing moves when it comes or goes.
void SimplexHeader::tell(const QString& outcome) { outcome_->show(outcome); }

void SimplexHeader::refresh(const Frame& frame, Place place) {
    refreshState(frame, place);
    refreshFault(frame, place);
    refreshAgent(frame, place);
    refreshNotice(frame, place);
    QStringList why{whyText(frame, place), goneInputText(frame, place)};
    why.removeAll({});
    showOrHide(*why_, why.join(' '));
    fit();
    // It may need another height now; what is around it is not laid out just now.
    if (parentWidget() != nullptr && parentWidget()->layout() != nullptr) {
        parentWidget()->layout()->activate();
    }
}

void SimplexHeader::refreshState(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    const Type& type = frame.type(place);
    const bool states = type.active() && !type.isA("Agent");
    since_->setVisible(states && !agent.lost());
    outcome_->setVisible(states);
    if (since_->isVisibleTo(this)) since_->show(times_.text(frame, place));
    if (type.isA("Agent")) {  // it has commands, but no state of its own
        mark_->show(agent.status.ended ? Shape::Ended : agent.lost() ? Shape::Lost : Shape::Agent);
        state_->show(agent.status.ended ? tr("ended") : QString::fromStdString(agent.status.state),
                     &Tokens::ink);
        return;
    }
    if (!states) {
        mark_->show(Shape::Data);
        state_->show(QLatin1String{name(frame.info(place).role)}, &Tokens::ink);
        return;
    }
    const auto state = agent.state(place.simplex), last = agent.lastState(place.simplex);
    const Shape shape = state ? shapeOf(*state) : Shape::Unknown;
    mark_->show(shape);
    state_->show(!state && last ? bracketed(word(shapeOf(*last))) : word(shape),
                 shape == Shape::Fault ? &Tokens::faultText : &Tokens::ink);
}

// "Fault 7" and below it the text, whole where it is known.
void SimplexHeader::refreshFault(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    const bool faulted = agent.state(place.simplex) == State::Fault;
    const QString code = faultCode(agent, place.simplex);
    if (faulted && !code.isEmpty()) state_->show(word(Shape::Fault) + code, &Tokens::faultText);
    const FaultText fault = faulted ? faultText(frame, place, times_) : FaultText{};
    showOrHide(*fault_, fault.text);
    fault_->setToolTip(fault.cut ? tr("The rest stands in the events.") : QString{});
}

void SimplexHeader::refreshAgent(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    const auto age = agent.age(place.simplex);
    const bool came = agent.came(place.simplex);
    const Excuse excuse = frame.excuse(place);
    QString text = tr("agent %1").arg(QString::fromStdString(agent.status.name));
    if (!age) {
        text = tr("%1, no values yet").arg(text);
    } else if (agent.lost() || (excuse != Excuse::Rests && !neverChanges(frame.info(place)))) {
        text = tr("%1, %2 old").arg(text, ageText(*age));
    }
    agent_->show(text);
    const Quality quality = agent.lost() ? Quality::Lost : agent.quality(place.simplex);
    const QString word = tr("quality %1").arg(QLatin1String{name(quality)});
    const bool amiss = came && quality != Quality::Good && excuse == Excuse::None;
    quality_->show(!came                     ? tr("waiting for the first values")
                   : excuse == Excuse::Rests ? tr("%1, at rest").arg(word)
                                             : word,
                   amiss ? &Tokens::dataText : &Tokens::ink2);
    showOrHide(*task_, taskText(agent, place.simplex));
}

void SimplexHeader::refreshNotice(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    const QString agentName = QString::fromStdString(agent.status.name);
    agentName_ = agent.status.name;
    QString notice = claimsText(frame, place, times_);
    QColor Tokens::* colour = &Tokens::warnText;
    if (agent.lost()) {
        const GoneAgent* gone = frame.goneFrom(frame.info(place).path);
        const QString ended =
            gone != nullptr ? goneText(*gone) : tr("%1 has ended.").arg(agentName);
        notice = agent.status.ended
                     ? tr("%1 Values are the last ones, in brackets.").arg(ended)
                     : tr("%1 is not heard for %2. Values are the last ones, in brackets.")
                           .arg(agentName, ageText(agent.status.age));
        colour = agent.status.ended ? &Tokens::ink : &Tokens::dataText;
    } else if (!agent.status.standstill.empty()) {
        notice = tr("%1 %2. Values are the last ones, in brackets.")
                     .arg(agentName, QString::fromStdString(agent.status.standstill));
        colour = &Tokens::dataText;
    }
    notice_->show(notice, colour);
    notice_->setVisible(!notice.isEmpty());
    dismiss_->setVisible(agent.lost());
}

}  // namespace cortex::gui

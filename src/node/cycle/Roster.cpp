// SPDX-License-Identifier: Apache-2.0
#include "Roster.h"

#include "NodeRegistry.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <iterator>
#include <map>

namespace qplc {

namespace {

Schedule::Node declarationOf(const NodeSlot &slot)
{
    Schedule::Node node;
    node.twoPhase = slot.twoPhase;
    for (const PayloadLayout::Field &field : slot.inputLayout.fields())
        node.inputs.push_back(
            {field.signal, node.inputs.size() < slot.sameCycle.size() && slot.sameCycle[node.inputs.size()]});
    for (const PayloadLayout::Field &field : slot.outputLayout.fields())
        node.outputs.push_back(field.signal);
    return node;
}

}  // namespace

Schedule scheduleOf(const std::vector<std::shared_ptr<NodeSlot>> &nodes)
{
    std::vector<Schedule::Node> declarations;
    declarations.reserve(nodes.size());
    for (const std::shared_ptr<NodeSlot> &slot : nodes)
        declarations.push_back(declarationOf(*slot));
    return Schedule(declarations);
}

void Roster::arrange(const ProcessImage &image)
{
    const Schedule schedule = scheduleOf(nodes);
    Q_ASSERT_X(schedule.isValid(), "Roster::arrange", "nodes that close an algebraic loop are not admitted");
    stages.assign(schedule.stageCount(), {});
    for (std::size_t i = 0; i < nodes.size(); ++i)
        stages[schedule.stage(i)].push_back({nodes[i].get(), schedule.feedsLaterStage(i)});
    written.assign(image.table().size(), false);
    for (const std::shared_ptr<NodeSlot> &slot : nodes) {
        for (const PayloadLayout::Field &field : slot->outputLayout.fields())
            written[field.signal] = field.signal >= held.size() || !held[field.signal];
        anyRemote = anyRemote || slot->peer;
        if (slot->twoPhase)
            twoPhase.push_back(slot.get());
        const auto isOfItsPart
            = [&](const std::shared_ptr<NodeSlot> &other) { return other->multicast == slot->multicast; };
        if (slot->multicast && std::none_of(multicast.begin(), multicast.end(), isOfItsPart))
            multicast.push_back(slot);
        if (!held.empty())
            pasted.push_back(SignalGuard::frameFor(image, slot->outputLayout, held));
    }
    findContests(image.table());
    safeImage = SafeImage(image, safe);
}

RosterContent Roster::describe() const
{
    RosterContent content;
    const auto signalsOf = [](const PayloadLayout &layout) {
        QVector<QPlcSignalIndex> indices;
        for (const PayloadLayout::Field &field : layout.fields())
            indices.append(field.signal);
        return indices;
    };
    for (std::size_t stage = 0; stage < stages.size(); ++stage) {
        for (const Turn &turn : stages[stage]) {
            const NodeSlot &slot = *turn.slot;
            RosterNode node;
            node.name = slot.name;
            node.id = slot.id;
            node.inputs = signalsOf(slot.inputLayout);
            node.outputs = signalsOf(slot.outputLayout);
            for (const bool isSame : slot.sameCycle)
                node.sameCycle.append(isSame);
            node.hasInputQualities = slot.inputLayout.hasQualities();
            node.hasOutputQualities = slot.outputLayout.hasQualities();
            node.isTwoPhase = slot.twoPhase;
            node.isListener = slot.listener;
            node.isLocal = slot.local != nullptr;
            node.hasDevices = slot.hardware;
            node.goesOn = slot.goesOn;
            node.interval = quint64(slot.interval.cycles());
            node.stage = int(stage);
            content.nodes.append(node);
        }
    }
    for (std::size_t signal = 0; signal < held.size(); ++signal) {
        if (held[signal])
            content.held.append(QPlcSignalIndex(signal));
    }
    return content;
}

bool Roster::isNeutral(QPlcSignalIndex signal) const noexcept
{
    const auto found
        = std::lower_bound(terms.begin(), terms.end(), signal,
                           [](const HeldTerm &term, QPlcSignalIndex wanted) { return term.signal < wanted; });
    return found != terms.end() && found->signal == signal && found->term->hasEnded();
}

void Roster::findContests(const QPlcSignalTable &table)
{
    std::map<QPlcSignalIndex, SignalGuard::Contest> bySignal;
    for (const std::shared_ptr<NodeSlot> &slot : nodes) {
        for (const SignalGuard::Frame::Field &field : slot->outputs.contested) {
            SignalGuard::Contest &contest = bySignal[QPlcSignalIndex(field.place)];
            contest.place = field.place;
            contest.candidates.push_back({slot->id, &slot->claims, field.number, field.from});
        }
    }
    const auto nameOf = [this](const SignalGuard::Contest::Candidate &candidate) {
        return (*std::find_if(nodes.begin(), nodes.end(),
                              [&](const std::shared_ptr<NodeSlot> &slot) { return slot->id == candidate.writer; }))
            ->name;
    };
    for (auto &[signal, contest] : bySignal) {
        if (signal < held.size() && held[signal])
            continue;
        const QStringList &order = table.at(signal).writers;
        std::sort(contest.candidates.begin(), contest.candidates.end(),
                  [&](const SignalGuard::Contest::Candidate &a, const SignalGuard::Contest::Candidate &b) {
                      return order.indexOf(nameOf(a)) < order.indexOf(nameOf(b));
                  });
        contests.push_back(contest);
    }
}

QString loopText(const Schedule &schedule, const std::vector<std::shared_ptr<NodeSlot>> &nodes,
                 const QPlcSignalTable &table)
{
    QStringList ports;
    const std::vector<Schedule::Hop> &loop = schedule.loop();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const QString &node = nodes[loop[i].node]->name;
        const Schedule::Hop &next = loop[(i + 1) % loop.size()];
        ports << QStringLiteral("%1.%2").arg(node, table.at(loop[i].input).name)
              << QStringLiteral("%1.%2").arg(node, table.at(next.input).name);
    }
    ports << ports.first();
    return ports.join(QStringLiteral(" -> "));
}

QPlcSchedule describeSchedule(const NodeRegistry &registry, const QPlcSignalTable &table)
{
    std::vector<std::shared_ptr<NodeSlot>> nodes;
    std::copy_if(registry.nodes().begin(), registry.nodes().end(), std::back_inserter(nodes),
                 [](const std::shared_ptr<NodeSlot> &slot) { return slot->isThere(); });
    const Schedule schedule = scheduleOf(nodes);
    QPlcSchedule described;
    QVector<QPlcSchedule::Turn> known;
    described.stages.resize(int(schedule.stageCount()));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const NodeSlot &slot = *nodes[i];
        if (slot.twoPhase)
            known.append({slot.name, QPlcSchedule::Outputs});
        described.stages[int(schedule.stage(i))].append(
            {slot.name, slot.twoPhase ? QPlcSchedule::Update : QPlcSchedule::Step});
        const Schedule::Node declaration = declarationOf(slot);
        for (const Schedule::Input &input : declaration.inputs) {
            const QString writer = registry.writer(input.signal);
            const bool isOfNode = !writer.isEmpty() && writer != NodeRegistry::masterName();
            described.links.append({table.at(input.signal).name, writer, slot.name,
                                    isOfNode && !input.sameCycle ? 1 : 0, input.sameCycle});
        }
    }
    if (!known.isEmpty())
        described.stages.prepend(known);
    return described;
}

}  // namespace qplc

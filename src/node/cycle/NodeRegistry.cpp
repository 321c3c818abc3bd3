// SPDX-License-Identifier: Apache-2.0
#include "NodeRegistry.h"

#include "Roster.h"
#include "node/Logging.h"
#include "protocol/messages/Vocabulary.h"
#include "signals/MessageText.h"
#include "signals/TypeNames.h"

#include <QtCore/QMetaEnum>

#include <algorithm>

namespace qplc {

namespace {

QMetaEnum policies()
{
    return QMetaEnum::fromType<QPlcSlaveNode::RealTimeViolationPolicy>();
}

std::vector<messages::DeclaredSignal> describe(const QPlcSignalTable &table, const PayloadLayout &layout)
{
    std::vector<messages::DeclaredSignal> declared;
    TypeNames names;
    for (const PayloadLayout::Field &field : layout.fields()) {
        const QPlcSignalDefinition &signal = table.at(field.signal);
        declared.push_back(
            {signal.name, names.of(field.type), signal.unit, false, messages::Hex64(table.safetyHash(field.signal))});
    }
    return declared;
}

}  // namespace

bool NodeDeclaration::fromMessage(const messages::Register &message, NodeDeclaration *declaration, QString *error)
{
    bool knownPolicy = false;
    const int policy = policies().keyToValue(message.policy.toLatin1().constData(), &knownPolicy);
    declaration->name = message.name;
    declaration->listener = message.listener;
    declaration->critical = message.critical && !message.listener;
    declaration->interval = ListeningInterval(message.every);
    declaration->twoPhase = message.twoPhase;
    declaration->quality = message.quality;
    declaration->outputQuality = message.outputQuality;
    declaration->watchdog = message.watchdog;
    declaration->inputs = message.inputs;
    declaration->outputs = message.outputs;
    *error = nameError(declaration->name);
    if (error->isEmpty() && !knownPolicy)
        *error = QStringLiteral("unknown policy '%1'").arg(message.policy);
    if (error->isEmpty() && message.transport.size() > messages::Register::mostOthers)
        *error = QStringLiteral("%1 fields that this master does not know; send at most %2 besides those of Register")
                     .arg(message.transport.size())
                     .arg(messages::Register::mostOthers);
    declaration->policy = QPlcSlaveNode::RealTimeViolationPolicy(policy);
    return error->isEmpty();
}

QString NodeDeclaration::nameError(const QString &name)
{
    if (name.isEmpty() || name.size() > LongestName)
        return QStringLiteral("a node needs a name of 1 ... %1 characters").arg(LongestName);
    if (name != printable(name))
        return QStringLiteral("the name '%1' has characters that cannot be shown").arg(printable(name));
    return {};
}

messages::Register NodeDeclaration::toMessage() const
{
    messages::Register message;
    message.name = name;
    message.policy = QLatin1String(policies().valueToKey(policy));
    message.listener = listener;
    message.critical = critical;
    message.every = interval.cycles();
    message.inputs = inputs;
    message.outputs = outputs;
    message.twoPhase = twoPhase;
    message.quality = quality;
    message.outputQuality = outputQuality;
    return message;
}

NodeDeclaration NodeDeclaration::fromRuntime(const NodeRuntime &runtime)
{
    NodeDeclaration declaration;
    static_cast<NodeTraits &>(declaration) = runtime.traits();
    declaration.critical = declaration.critical && !declaration.listener;
    declaration.quality = runtime.inputLayout().hasQualities();
    declaration.inputs = describe(runtime.table(), runtime.inputLayout());
    for (std::size_t i = 0; i < declaration.inputs.size(); ++i)
        declaration.inputs[i].sameCycle = runtime.sameCycle()[i];
    declaration.outputs = describe(runtime.table(), runtime.outputLayout());
    return declaration;
}

NodeRegistry::NodeRegistry(const QPlcSignalTable &table)
    : m_table(table)
    , m_writers(table.size())
{
}

bool NodeRegistry::resolve(const QString &node, const std::vector<messages::DeclaredSignal> &declared,
                           QVector<QPlcSignalIndex> *indices, Refusal *refusal) const
{
    std::vector<bool> seen(std::size_t(m_table.size()));
    TypeNames names;
    for (const messages::DeclaredSignal &signal : declared) {
        const QPlcSignalIndex index = m_table.indexOf(signal.name);
        if (index == QPlcInvalidSignalIndex) {
            *refusal = {messages::errorWord::unknownSignal,
                        QStringLiteral("node '%1': %2").arg(node, m_table.unknownSignalText(signal.name))};
            return false;
        }
        const QPlcSignalDefinition &definition = m_table.at(index);
        if (names.of(definition.type) != signal.type) {
            *refusal = {messages::errorWord::typeMismatch,
                        QStringLiteral(
                            "signal '%1' is %2 in the table of the master, %3 in that of node '%4'; use the same table")
                            .arg(signal.name, names.of(definition.type), signal.type, node)};
            return false;
        }
        if (definition.unit != signal.unit) {
            *refusal = {messages::errorWord::unitMismatch,
                        QStringLiteral("signal '%1' is in '%2' in the table of the master, in '%3' in that of node "
                                       "'%4'; use the same table")
                            .arg(signal.name, definition.unit, signal.unit, node)};
            return false;
        }
        if (seen[index]) {
            *refusal = {messages::errorWord::malformedMessage,
                        QStringLiteral("node '%1' declares signal '%2' twice; declare it once").arg(node, signal.name)};
            return false;
        }
        seen[index] = true;
        indices->append(index);
    }
    return true;
}

/// A node that loses the master becomes safe by its own table: with other parameters it would do
/// what the plant does not expect.
bool NodeRegistry::agreeOnSafety(const NodeDeclaration &declaration, const QVector<QPlcSignalIndex> &inputs,
                                 const QVector<QPlcSignalIndex> &outputs, Refusal *refusal) const
{
    QStringList others;
    const auto compare
        = [&](const std::vector<messages::DeclaredSignal> &declared, const QVector<QPlcSignalIndex> &indices) {
              for (std::size_t i = 0; i < declared.size(); ++i) {
                  const messages::DeclaredSignal &signal = declared[i];
                  if (signal.safety && *signal.safety != m_table.safetyHash(indices.at(int(i))))
                      others.append(QStringLiteral("'%1'").arg(signal.name));
              }
          };
    compare(declaration.inputs, inputs);
    compare(declaration.outputs, outputs);
    others.removeDuplicates();
    if (!others.isEmpty())
        *refusal = {messages::errorWord::safetyMismatch,
                    QStringLiteral("the safety parameters (min, max, safe, hold, nan, slope, writer) of %1 differ "
                                   "between the master and node '%2'; use the same table, or start the node without "
                                   "one")
                        .arg(firstOf(others, 5), declaration.name)};
    return others.isEmpty();
}

std::shared_ptr<NodeSlot> NodeRegistry::admit(const NodeDeclaration &declaration, Refusal *refusal)
{
    if (!hasPlace(declaration.name, refusal))
        return nullptr;
    std::shared_ptr<NodeSlot> slot = make(declaration, refusal);
    if (!slot)
        return nullptr;
    slot->id = freeId();
    return add(slot, refusal) ? slot : nullptr;
}

bool NodeRegistry::hasPlace(const QString &name, Refusal *refusal) const
{
    const auto sameName = [&](const std::shared_ptr<NodeSlot> &slot) { return slot->name == name; };
    if (name == masterName() || std::any_of(m_nodes.begin(), m_nodes.end(), sameName)) {
        *refusal = {messages::errorWord::nameInUse,
                    QStringLiteral("there is a node '%1' already; give this one another name, or stop the other one")
                        .arg(name)};
        return false;
    }
    if (m_nodes.size() >= MaximumNodes) {
        *refusal = {messages::errorWord::tooManyNodes,
                    QStringLiteral("node '%1' would be number %2; a master serves at most %3")
                        .arg(name)
                        .arg(m_nodes.size() + 1)
                        .arg(MaximumNodes)};
        return false;
    }
    return true;
}

std::shared_ptr<NodeSlot> NodeRegistry::make(const NodeDeclaration &declaration, Refusal *refusal) const
{
    if (!declaration.interval.isEveryCycle() && !(declaration.listener && declaration.outputs.empty())) {
        *refusal
            = {messages::errorWord::malformedMessage,
               QStringLiteral("node '%1' wants one of %2 cycles: that is for listeners without outputs; let it take "
                              "every cycle, or declare it a listener and its outputs elsewhere")
                   .arg(declaration.name)
                   .arg(declaration.interval.cycles())};
        return nullptr;
    }
    QVector<QPlcSignalIndex> inputs;
    QVector<QPlcSignalIndex> outputs;
    if (!resolve(declaration.name, declaration.inputs, &inputs, refusal)
        || !resolve(declaration.name, declaration.outputs, &outputs, refusal)
        || !agreeOnSafety(declaration, inputs, outputs, refusal))
        return nullptr;
    auto slot = std::make_shared<NodeSlot>();
    slot->name = declaration.name;
    slot->policy = declaration.policy;
    slot->listener = declaration.listener;
    slot->critical = declaration.critical;
    slot->hardware = declaration.hardware;
    slot->watchdog = declaration.watchdog.value_or(std::chrono::nanoseconds(0));
    slot->interval = declaration.interval;
    slot->twoPhase = declaration.twoPhase;
    for (const messages::DeclaredSignal &input : declaration.inputs)
        slot->sameCycle.push_back(input.sameCycle);
    const auto with
        = [](bool qualities) { return qualities ? PayloadLayout::WithQualities : PayloadLayout::WithoutQualities; };
    slot->inputLayout = PayloadLayout(m_table, inputs, with(declaration.quality));
    slot->outputLayout = PayloadLayout(m_table, outputs, with(declaration.outputQuality));
    return slot;
}

bool NodeRegistry::add(const std::shared_ptr<NodeSlot> &slot, Refusal *refusal)
{
    if (!hasPlace(slot->name, refusal))
        return false;
    for (const PayloadLayout::Field &output : slot->outputLayout.fields()) {
        if (!mayWrite(slot->name, output.signal, refusal))
            return false;
    }
    if (closesLoop(slot, refusal))
        return false;
    for (const PayloadLayout::Field &output : slot->outputLayout.fields())
        addWriter(slot->name, output.signal);
    m_nodes.push_back(slot);
    return true;
}

bool NodeRegistry::mayWrite(const QString &name, QPlcSignalIndex signal, Refusal *refusal) const
{
    const QPlcSignalDefinition &definition = m_table.at(signal);
    const QStringList &present = m_writers.at(signal);
    if (!definition.writers.isEmpty() && !definition.writers.contains(name))
        *refusal
            = {messages::errorWord::writerNotNamed,
               QStringLiteral("signal '%1' cannot be written by node '%2': the table of the master has 'writer = %3'; "
                              "name the node there, or give it one of these names")
                   .arg(definition.name, name, definition.writers.join(QStringLiteral(" > ")))};
    else if (!present.isEmpty() && (definition.writers.size() < 2 || present.contains(masterName())))
        *refusal = {messages::errorWord::signalHasWriter,
                    QStringLiteral("signal '%1' cannot be written by node '%2': node '%3' writes it; a signal has one "
                                   "writer, unless 'writer =' of the table names several")
                        .arg(definition.name, name, present.first())};
    return refusal->error.isEmpty();
}

void NodeRegistry::addWriter(const QString &name, QPlcSignalIndex signal)
{
    QStringList &present = m_writers[signal];
    const QStringList &order = m_table.at(signal).writers;
    const auto isBehind = [&](const QString &other) { return order.indexOf(other) > order.indexOf(name); };
    present.insert(std::find_if(present.begin(), present.end(), isBehind), name);
}

/// Among those that are there, there is none: a loop goes through one of its same-cycle inputs.
bool NodeRegistry::closesLoop(const std::shared_ptr<NodeSlot> &slot, Refusal *refusal) const
{
    if (std::find(slot->sameCycle.begin(), slot->sameCycle.end(), true) == slot->sameCycle.end())
        return false;
    std::vector<std::shared_ptr<NodeSlot>> nodes = m_nodes;
    nodes.push_back(slot);
    const Schedule schedule = scheduleOf(nodes);
    if (schedule.isValid())
        return false;
    const QString loop = loopText(schedule, nodes, m_table);
    *refusal
        = {messages::errorWord::algebraicLoop,
           QStringLiteral("node '%1' closes an algebraic loop: %2; make one of these inputs not same-cycle, or one "
                          "of these nodes two-phase")
               .arg(slot->name, loop)};
    return true;
}

quint16 NodeRegistry::freeId() const
{
    do {
        ++m_lastId;
    } while (m_lastId == 0 || find(m_lastId));
    return m_lastId;
}

std::shared_ptr<NodeSlot> NodeRegistry::find(quint16 id) const
{
    const auto found = std::find_if(m_nodes.begin(), m_nodes.end(),
                                    [id](const std::shared_ptr<NodeSlot> &slot) { return slot->id == id; });
    return found == m_nodes.end() ? nullptr : *found;
}

void NodeRegistry::remove(const std::shared_ptr<NodeSlot> &slot)
{
    for (const PayloadLayout::Field &field : slot->outputLayout.fields())
        m_writers[field.signal].removeAll(slot->name);
    m_nodes.erase(std::remove(m_nodes.begin(), m_nodes.end(), slot), m_nodes.end());
}

bool NodeRegistry::claim(QPlcSignalIndex signal)
{
    if (!m_writers.at(signal).isEmpty())
        return false;
    m_writers[signal] = QStringList{masterName()};
    return true;
}

void NodeRegistry::release(QPlcSignalIndex signal)
{
    m_writers[signal].removeAll(masterName());
}

}  // namespace qplc

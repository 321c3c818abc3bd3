// SPDX-License-Identifier: Apache-2.0
#include "NemesisPlan.h"

#include <QtCore/QRegularExpression>

#include <algorithm>
#include <random>

namespace soak {

namespace {

// Order of FaultKind.
constexpr std::array<int, FaultKinds> AllKinds{14, 6, 2, 2, 6, 5, 3,
                                               3,  2, 4, 3, 3, 3, 4};  // none of those of simulated plants

int amountOf(FaultKind kind)
{
    switch (kind) {
    case FaultKind::StopNode:
    case FaultKind::StopMaster:
        return 300;
    case FaultKind::GarbageDatagrams:
    case FaultKind::GarbageToNodes:
    case FaultKind::StoppedReader:
        return 100;
    case FaultKind::GarbageControl:
        return 8;
    case FaultKind::ConnectFlood:
        return 200;
    case FaultKind::LoseFrames:
    case FaultKind::DuplicateFrames:
    case FaultKind::ReorderFrames:
    case FaultKind::CorruptFrames:
    case FaultKind::CutLink:
    case FaultKind::PowerNode:
    case FaultKind::PowerMaster:
    case FaultKind::CutRoad:
    case FaultKind::CutRoadToNode:
    case FaultKind::DelayOnRoad:
    case FaultKind::LoseOnRoads:
    case FaultKind::DisorderOnRoads:
    case FaultKind::SlowListener:
    case FaultKind::EchoOnRoads:
    case FaultKind::EvictNode:
    case FaultKind::MissingNode:
    case FaultKind::Siege:
    case FaultKind::OtherParameters:
        return 700;
    case FaultKind::SilentJoiner:
        return 100;
    default:
        return 1;
    }
}

QString faultNames()
{
    QStringList names;
    for (const char *name : FaultNames)
        names << QString::fromLatin1(name);
    return names.join(QStringLiteral(", "));
}

}  // namespace

std::optional<Profile> Profile::named(const QString &name)
{
    Profile profile;
    profile.name = name;
    if (name == QLatin1String("short")) {
        profile.faultEvery = 500;
        profile.faultCount = 60;
        profile.weights = AllKinds;
    } else if (name == QLatin1String("steady")) {
        profile.shape = {16, 250, 25};
        profile.priority = 40;
        profile.periodUs = 2000;
        profile.seconds = 600;
        profile.isLoaded = true;
        profile.judgesMemory = true;
    } else if (name == QLatin1String("faults")) {
        profile.shape = {64, 100, 3};
        profile.seconds = 600;
        profile.faultEvery = 1000;
        profile.judgesMemory = true;
        profile.weights = AllKinds;
    } else if (name == QLatin1String("crowd")) {
        profile.shape = {254, 20, 3};
        profile.periodUs = 50'000;  // as two processors hold it
        profile.seconds = 600;
        profile.judgesMemory = true;
        profile.restless = 0.2;
        profile.faultEvery = 200;
        profile.weights[std::size_t(FaultKind::KillNode)] = 1;
        profile.attemptsPerSecond = 100;
    } else if (name == QLatin1String("intruders")) {
        profile.seconds = 30;
        profile.faultEvery = 1000;
        profile.attemptsPerSecond = 100;
        for (const FaultKind kind : {FaultKind::KillNode, FaultKind::StopNode, FaultKind::GarbageDatagrams,
                                     FaultKind::GarbageToNodes, FaultKind::LoseFrames, FaultKind::CutLink})
            profile.weights[std::size_t(kind)] = 1;
    } else {
        return std::nullopt;
    }
    return profile;
}

QString linkFaultsOf(FaultKind kind, quint64 seed)
{
    const QString end = QStringLiteral(",seed=%1").arg(seed);
    switch (kind) {
    case FaultKind::LoseFrames:
        return QStringLiteral("loss-sent=10%") + end;
    case FaultKind::DuplicateFrames:
        return QStringLiteral("duplicate-sent=20%,duplicate-received=20%") + end;
    case FaultKind::ReorderFrames:
        return QStringLiteral("reorder-sent=10%,reorder-received=10%") + end;
    case FaultKind::CorruptFrames:
        return QStringLiteral("corrupt-sent=10%,corrupt-received=10%") + end;
    default:
        return QStringLiteral("cut=300ms+200ms") + end;
    }
}

QString Fault::toString() const
{
    QString text = QString::fromLatin1(FaultNames[std::size_t(kind)]);
    if (node >= 0)
        text += QStringLiteral(" (%1)").arg(nodeName(node));
    text += QStringLiteral(", %1, seed %2").arg(amount).arg(seed);
    return pause < 0 ? text : text + QStringLiteral("; the next one %1 ms later").arg(pause);
}

QString Fault::read(const QString &text, int nodes, Fault *fault)
{
    static const QRegularExpression form(QRegularExpression::anchoredPattern(QStringLiteral(
        "([^(),;]+)(?: \\((\\w+)\\))?, (\\d{1,9}), seed (\\d{1,20})(?:; the next one (\\d{1,9}) ms later)?")));
    const QRegularExpressionMatch match = form.match(text);
    if (!match.hasMatch())
        return QStringLiteral("'%1' is not a fault; write it as \"stop a node (%2), 300, seed 815\", with "
                              "\"; the next one 120 ms later\" behind it if the next one does not wait")
            .arg(text, nodeName(3));
    const QString name = match.captured(1);
    const auto kind = std::find(FaultNames.begin(), FaultNames.end(), name);
    if (kind == FaultNames.end())
        return QStringLiteral("unknown fault '%1'; use %2").arg(name, faultNames());
    fault->kind = FaultKind(kind - FaultNames.begin());
    const QString node = match.captured(2);
    fault->node = nodeNumber(node);
    if (!hasNode(fault->kind) && !node.isEmpty())
        return QStringLiteral("'%1' is not of a single node; leave (%2) out").arg(name, node);
    if (hasNode(fault->kind) && (fault->node < 0 || fault->node >= nodes))
        return QStringLiteral("'%1' needs a node from (%2) to (%3)").arg(name, nodeName(0), nodeName(nodes - 1));
    fault->amount = match.captured(3).toInt();
    fault->seed = match.captured(4).toULongLong();
    fault->pause = match.captured(5).isEmpty() ? -1 : match.captured(5).toInt();
    return {};
}

QStringList Profile::names()
{
    return {QStringLiteral("short"), QStringLiteral("steady"), QStringLiteral("faults"), QStringLiteral("crowd"),
            QStringLiteral("intruders")};
}

std::vector<Fault> planOf(const Profile &profile, int count, quint64 seed)
{
    std::mt19937_64 random(seed);
    int allWeights = 0;
    for (const int weight : profile.weights)
        allWeights += weight;
    std::vector<Fault> plan;
    // Number i of the kinds in their order of weights: what is drawn is the order alone, so that
    // every run has all kinds.
    for (int i = 0; i < count && allWeights > 0; ++i) {
        int place = int(qint64(i) * allWeights / count);
        int kind = 0;
        while (place >= profile.weights[std::size_t(kind)])
            place -= profile.weights[std::size_t(kind++)];
        Fault fault;
        fault.kind = FaultKind(kind);
        fault.amount = amountOf(fault.kind);
        plan.push_back(fault);
    }
    for (std::size_t i = plan.size(); i > 1; --i)
        std::swap(plan[i - 1], plan[random() % i]);
    const int nodes = std::max(1, int(profile.shape.nodes * profile.restless));
    for (Fault &fault : plan) {
        fault.node = hasNode(fault.kind) ? int(random() % quint64(nodes)) : -1;
        if (isLinkFault(fault.kind) && isOnStream(fault.node))
            --fault.node;
        fault.seed = random();
    }
    return plan;
}

}  // namespace soak

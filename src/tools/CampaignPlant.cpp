// SPDX-License-Identifier: Apache-2.0
#include "CampaignPlant.h"

#include "WaitFor.h"

#include <array>

namespace tools {

namespace {

constexpr std::chrono::seconds longestPlantStart{15};  // until all nodes are there, and until cycles run
constexpr std::chrono::seconds warmUp{1};
constexpr std::chrono::milliseconds plantPause{5};  // between two looks at its state

QString inputName(int node)
{
    return QStringLiteral("in%1").arg(node);
}

QString outputName(int node)
{
    return QStringLiteral("out%1").arg(node);
}

/// Ten numbers to each node, and ten back.
QPlcSignalTable tableFor(int nodes)
{
    QString ini;
    for (int node = 0; node < nodes; ++node)
        ini += QStringLiteral("[%1]\ntype = Real64[10]\n[%2]\ntype = Real64[10]\n")
                   .arg(inputName(node), outputName(node));
    return QPlcSignalTable::fromIni(ini.toUtf8());
}

}  // namespace

QPlcRealTimeOptions CampaignSettings::optionsOfNodes(bool isRealTime) const
{
    QPlcRealTimeOptions options;
    options.policy = isRealTime ? QPlcRealTimeOptions::Fifo : QPlcRealTimeOptions::Other;
    options.priority = isRealTime ? priority : 0;
    options.lockMemory = isRealTime;
    return options;
}

QPlcRealTimeOptions CampaignSettings::optionsOfMaster(bool isRealTime) const
{
    QPlcRealTimeOptions options = optionsOfNodes(isRealTime);
    options.cpu = cpu;
    return options;
}

/// Gives back what it gets.
class CampaignPlant::Node : public QPlcCompactSlaveNode
{
public:
    explicit Node(int number)
        : QPlcCompactSlaveNode(QStringLiteral("Node%1").arg(number))
        , m_in(this, inputName(number).toUtf8().constData())
        , m_out(this, outputName(number).toUtf8().constData())
    {
    }
    ~Node() override { disconnectFromMaster(); }

private:
    using Numbers = std::array<double, 10>;

    void step(const QPlcCycle &) override { m_out = m_in.value(); }

    QPlcInput<Numbers> m_in;
    QPlcOutput<Numbers> m_out;
};

CampaignPlant::CampaignPlant() = default;

CampaignPlant::~CampaignPlant()
{
    m_master.stop();
}

bool CampaignPlant::prepare(const CampaignCase &of, const CampaignSettings &settings, QString *error)
{
    m_master.setRealTimeOptions(settings.optionsOfMaster(of.isRealTime));
    m_master.setArmingRequired(false);  // nothing moves here
    if (!m_master.setSignalTable(tableFor(settings.nodes)) || !m_master.setInterval(of.period)
        || !m_master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0))) {
        *error = m_master.errorString();
        return false;
    }
    if (!admitNodes(of, settings, error) || !start(error))
        return false;
    const bool isWarm = waitFor(warmUp, plantPause, [this] { return !isRunning(); }) == Waited::TimeIsUp;
    m_master.stop();
    if (!isWarm)
        *error = QStringLiteral("the cycles end by themselves: %1").arg(m_master.errorString());
    return isWarm;
}

bool CampaignPlant::admitNodes(const CampaignCase &of, const CampaignSettings &settings, QString *error)
{
    const QString address = QStringLiteral("%1://127.0.0.1:%2").arg(of.transport).arg(m_master.serverPort());
    for (int node = 0; node < settings.nodes; ++node) {
        m_nodes.push_back(std::make_unique<Node>(node));
        m_nodes.back()->setRealTimeOptions(settings.optionsOfNodes(of.isRealTime));
        m_nodes.back()->connectToMaster(QPlcUnderlyingProtocol::fromString(address));
    }
    const auto areThere = [&] { return m_master.nodes().size() == settings.nodes; };
    if (waitFor(longestPlantStart, plantPause, areThere) == Waited::Done)
        return true;
    *error = QStringLiteral("only %1 of %2 nodes connect within %3 s")
                 .arg(m_master.nodes().size())
                 .arg(settings.nodes)
                 .arg(longestPlantStart.count());
    return false;
}

bool CampaignPlant::start(QString *error)
{
    const auto hasAnswered = [this] { return isRunning() || m_master.error() != QPlcMasterNode::NoError; };
    if (m_master.startRealTime() && waitFor(longestPlantStart, plantPause, hasAnswered) == Waited::Done && isRunning())
        return true;
    *error = QStringLiteral("the cycles do not start: %1").arg(m_master.errorString());
    return false;
}

}  // namespace tools

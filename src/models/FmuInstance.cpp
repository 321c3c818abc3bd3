// SPDX-License-Identifier: Apache-2.0
#include "FmuInstance.h"

#include "FmuLog.h"
#include "signals/MessageText.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QUrl>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <dlfcn.h>

namespace qplc {

std::atomic<const char *> FmuInstance::s_call{nullptr};
std::atomic<bool> FmuInstance::s_isInside{false};
thread_local bool FmuInstance::s_isHere = false;
std::atomic<FmuInstance *> FmuInstance::s_abandoned{nullptr};

namespace {

// ---- FMI 2.0 ----

void logOf2(void *environment, const char *, int status, const char *category, const char *message, ...)
{
    std::va_list arguments;
    va_start(arguments, message);
    if (environment)
        static_cast<FmuLog *>(environment)->addFormatted(status, category, message, arguments);
    va_end(arguments);
}

/// For kinds that FMI 2.0 does not have there are no functions; no variable has one.
int slotOf2(FmuVariable::Kind kind)
{
    return kind == FmuVariable::Float64 ? 0 : kind == FmuVariable::Int32 ? 1 : kind == FmuVariable::Boolean ? 2 : 3;
}

class Fmi2Instance final : public FmuInstance
{
public:
    static constexpr Names names{"fmi2GetVersion", "fmi2Instantiate", "fmi2FreeInstance", "fmi2ExitInitializationMode",
                                 "fmi2Terminate",  "fmi2Reset"};

    Fmi2Instance(const FmuDescription &description, const std::shared_ptr<FmuLog> &log)
        : FmuInstance(description, names, log)
        , m_callbacks{logOf2, std::calloc, std::free, [](void *, int) {}, log.get()}
    {
    }

    int enterInitializationMode(const Experiment &experiment) override
    {
        const Call inside("fmi2SetupExperiment");
        const int status
            = m_setupExperiment(m_instance, experiment.tolerance ? 1 : 0, experiment.tolerance.value_or(0.0),
                                experiment.startTime, experiment.stopTime ? 1 : 0, experiment.stopTime.value_or(0.0));
        return status > fmi::Warning ? status : call("fmi2EnterInitializationMode", m_enterInitializationMode);
    }

    int get(FmuVariable::Kind kind, const fmi::ValueReference *references, std::size_t count, void *values,
            std::size_t) override
    {
        const int slot = slotOf2(kind);
        const Call inside(getNames[std::size_t(slot)]);
        return m_get[std::size_t(slot)](m_instance, references, count, values);
    }

    int set(FmuVariable::Kind kind, const fmi::ValueReference *references, std::size_t count, const void *values,
            std::size_t) override
    {
        const int slot = slotOf2(kind);
        const Call inside(setNames[std::size_t(slot)]);
        return m_set[std::size_t(slot)](m_instance, references, count, values);
    }

    Step doStep(double time, double step) override
    {
        Step result;
        const Call inside("fmi2DoStep");
        result.lastTime = time;
        result.status = m_doStep(m_instance, time, step, 1);
        if (result.status == fmi::Discard && m_getBooleanStatus) {
            int isOver = 0;
            result.isOver = m_getBooleanStatus(m_instance, fmi2::Terminated, &isOver) == fmi::Ok && isOver != 0;
            if (result.isOver && m_getRealStatus
                && m_getRealStatus(m_instance, fmi2::LastSuccessfulTime, &result.lastTime) != fmi::Ok)
                result.lastTime = time;
        }
        return result;
    }

private:
    static constexpr std::array<const char *, 4> getNames{"fmi2GetReal", "fmi2GetInteger", "fmi2GetBoolean",
                                                          "fmi2GetString"};
    static constexpr std::array<const char *, 4> setNames{"fmi2SetReal", "fmi2SetInteger", "fmi2SetBoolean",
                                                          "fmi2SetString"};

    bool loadFunctions(const FmuDescription &) override
    {
        find(names.instantiate, &m_instantiate);
        find("fmi2SetupExperiment", &m_setupExperiment);
        find("fmi2EnterInitializationMode", &m_enterInitializationMode);
        find("fmi2DoStep", &m_doStep);
        for (std::size_t i = 0; i < m_get.size(); ++i) {
            find(getNames[i], &m_get[i]);
            find(setNames[i], &m_set[i]);
        }
        m_getBooleanStatus = reinterpret_cast<fmi2::GetBooleanStatus>(symbol("fmi2GetBooleanStatus"));
        m_getRealStatus = reinterpret_cast<fmi2::GetRealStatus>(symbol("fmi2GetRealStatus"));
        return true;
    }

    fmi::Instance make(const QByteArray &name, const QByteArray &resources, bool logs) override
    {
        const QByteArray url = QUrl::fromLocalFile(QFile::decodeName(resources)).toEncoded();
        return m_instantiate(name.constData(), fmi2::CoSimulation, m_token.constData(), url.constData(), &m_callbacks,
                             0, logs ? 1 : 0);
    }

    const fmi2::Callbacks m_callbacks;
    fmi2::Instantiate m_instantiate = nullptr;
    fmi2::SetupExperiment m_setupExperiment = nullptr;
    fmi::OfInstance m_enterInitializationMode = nullptr;
    std::array<fmi2::Get, 4> m_get{};
    std::array<fmi2::Set, 4> m_set{};
    fmi2::DoStep m_doStep = nullptr;
    fmi2::GetBooleanStatus m_getBooleanStatus = nullptr;
    fmi2::GetRealStatus m_getRealStatus = nullptr;
};

// ---- FMI 3.0 ----

void logOf3(void *environment, int status, const char *category, const char *message)
{
    if (environment)
        static_cast<FmuLog *>(environment)->add(status, category, message);
}

struct AccessNames
{
    const char *get;
    const char *set;
};
constexpr std::array<AccessNames, FmuVariable::String + 1> accessOf3{AccessNames{"fmi3GetFloat32", "fmi3SetFloat32"},
                                                                     {"fmi3GetFloat64", "fmi3SetFloat64"},
                                                                     {"fmi3GetInt8", "fmi3SetInt8"},
                                                                     {"fmi3GetUInt8", "fmi3SetUInt8"},
                                                                     {"fmi3GetInt16", "fmi3SetInt16"},
                                                                     {"fmi3GetUInt16", "fmi3SetUInt16"},
                                                                     {"fmi3GetInt32", "fmi3SetInt32"},
                                                                     {"fmi3GetUInt32", "fmi3SetUInt32"},
                                                                     {"fmi3GetInt64", "fmi3SetInt64"},
                                                                     {"fmi3GetUInt64", "fmi3SetUInt64"},
                                                                     {"fmi3GetBoolean", "fmi3SetBoolean"},
                                                                     {"fmi3GetString", "fmi3SetString"}};

class Fmi3Instance final : public FmuInstance
{
public:
    static constexpr Names names{"fmi3GetVersion",   "fmi3InstantiateCoSimulation",
                                 "fmi3FreeInstance", "fmi3ExitInitializationMode",
                                 "fmi3Terminate",    "fmi3Reset"};

    Fmi3Instance(const FmuDescription &description, const std::shared_ptr<FmuLog> &log)
        : FmuInstance(description, names, log)
    {
    }

    int enterInitializationMode(const Experiment &experiment) override
    {
        const Call inside("fmi3EnterInitializationMode");
        return m_enterInitializationMode(m_instance, experiment.tolerance.has_value(),
                                         experiment.tolerance.value_or(0.0), experiment.startTime,
                                         experiment.stopTime.has_value(), experiment.stopTime.value_or(0.0));
    }

    int get(FmuVariable::Kind kind, const fmi::ValueReference *references, std::size_t count, void *values,
            std::size_t valueCount) override
    {
        const Call inside(accessOf3[kind].get);
        return m_get[kind](m_instance, references, count, values, valueCount);
    }

    int set(FmuVariable::Kind kind, const fmi::ValueReference *references, std::size_t count, const void *values,
            std::size_t valueCount) override
    {
        const Call inside(accessOf3[kind].set);
        return m_set[kind](m_instance, references, count, values, valueCount);
    }

    Step doStep(double time, double step) override
    {
        Step result;
        const Call inside("fmi3DoStep");
        result.lastTime = time;
        result.status = m_doStep(m_instance, time, step, true, &result.needsEvent, &result.isOver, &result.isEarly,
                                 &result.lastTime);
        return result;
    }

    int enterEventMode() override { return call("fmi3EnterEventMode", m_enterEventMode); }
    int enterStepMode() override { return call("fmi3EnterStepMode", m_enterStepMode); }

    int updateDiscreteStates(bool *needsUpdate, bool *isOver) override
    {
        bool nominalsChanged = false;
        bool statesChanged = false;
        bool nextEventTimeDefined = false;
        double nextEventTime = 0.0;
        const Call inside("fmi3UpdateDiscreteStates");
        return m_updateDiscreteStates(m_instance, needsUpdate, isOver, &nominalsChanged, &statesChanged,
                                      &nextEventTimeDefined, &nextEventTime);
    }

private:
    bool loadFunctions(const FmuDescription &description) override
    {
        find(names.instantiate, &m_instantiate);
        find("fmi3EnterInitializationMode", &m_enterInitializationMode);
        find("fmi3DoStep", &m_doStep);
        if (m_usesEventMode) {
            find("fmi3EnterEventMode", &m_enterEventMode);
            find("fmi3EnterStepMode", &m_enterStepMode);
            find("fmi3UpdateDiscreteStates", &m_updateDiscreteStates);
        }
        for (std::size_t kind = 0; kind < accessOf3.size(); ++kind) {
            const auto isOfKind = [kind](const FmuVariable &variable) { return variable.kind == kind; };
            if (std::any_of(description.variables.begin(), description.variables.end(), isOfKind)) {
                find(accessOf3[kind].get, &m_get[kind]);
                find(accessOf3[kind].set, &m_set[kind]);
            }
        }
        return true;
    }

    fmi::Instance make(const QByteArray &name, const QByteArray &resources, bool logs) override
    {
        return m_instantiate(name.constData(), m_token.constData(), (resources + '/').constData(), false, logs,
                             m_usesEventMode, false, nullptr, 0, m_log.get(), logOf3, nullptr);
    }

    fmi3::Instantiate m_instantiate = nullptr;
    fmi3::EnterInitializationMode m_enterInitializationMode = nullptr;
    fmi::OfInstance m_enterEventMode = nullptr;
    fmi::OfInstance m_enterStepMode = nullptr;
    fmi3::UpdateDiscreteStates m_updateDiscreteStates = nullptr;
    std::array<fmi3::Get, accessOf3.size()> m_get{};
    std::array<fmi3::Set, accessOf3.size()> m_set{};
    fmi3::DoStep m_doStep = nullptr;
};

}  // namespace

// ---- both ----

FmuInstance::FmuInstance(const FmuDescription &description, const Names &names, const std::shared_ptr<FmuLog> &log)
    : m_names(&names)
    , m_log(log)
    , m_modelName(description.modelName.toUtf8())
    , m_token(description.token.toUtf8())
    , m_usesEventMode(description.hasEventMode)
{
}

FmuInstance::~FmuInstance()
{
    free();
    if (m_library)
        ::dlclose(m_library);
}

std::unique_ptr<FmuInstance> FmuInstance::load(const FmuDescription &description, const QString &fileName,
                                               const std::shared_ptr<FmuLog> &log, QString *error)
{
    std::unique_ptr<FmuInstance> instance;
    if (description.version == 2)
        instance = std::make_unique<Fmi2Instance>(description, log);
    else
        instance = std::make_unique<Fmi3Instance>(description, log);
    if (!instance->open(fileName, error) || !instance->check(description, error))
        return nullptr;
    return instance;
}

bool FmuInstance::open(const QString &fileName, QString *error)
{
    const Call inside("dlopen");
    m_library = ::dlopen(QFile::encodeName(fileName).constData(), RTLD_NOW | RTLD_LOCAL);
    if (m_library)
        return true;
    const QString reason = QString::fromLocal8Bit(::dlerror());
    const QString own = QFileInfo(fileName).fileName();
    const QString missing = reason.section(QLatin1String(": "), 0, 0);
    if (reason.contains(QLatin1String("cannot open shared object file")) && !missing.endsWith(own))
        *error
            = QStringLiteral("its library %1 needs the library %2, which this computer does not have; install it, or "
                             "set LD_LIBRARY_PATH to its folder")
                  .arg(own, missing);
    else if (reason.contains(QLatin1String("failed to map")))
        *error = QStringLiteral("its library cannot be loaded from %1, where programs may not run; set TMPDIR to "
                                "another folder (%2)")
                     .arg(QFileInfo(fileName).path(), reason);
    else
        *error = QStringLiteral("its library %1 cannot be loaded: %2").arg(own, printable(reason));
    return false;
}

bool FmuInstance::check(const FmuDescription &description, QString *error)
{
    find(m_names->version, &m_version);
    find(m_names->freeInstance, &m_free);
    find(m_names->exitInitializationMode, &m_exitInitializationMode);
    find(m_names->terminate, &m_terminate);
    find(m_names->reset, &m_reset);
    loadFunctions(description);
    if (!m_missing.isEmpty()) {
        *error = QStringLiteral("its library lacks %1 of FMI %2; export the FMU again for co-simulation, with all "
                                "functions of the standard")
                     .arg(firstOf(m_missing), description.versionText);
        return false;
    }
    const Call inside(m_names->version);
    const QString version = QString::fromUtf8(m_version());
    if (version.section(QLatin1Char('.'), 0, 0).toInt() == description.version)
        return true;
    *error = QStringLiteral("its library follows FMI %1, and its modelDescription.xml FMI %2; they do not belong "
                            "together: export the FMU again")
                 .arg(quoted(version), description.versionText);
    return false;
}

void *FmuInstance::symbol(const char *name) const
{
    return ::dlsym(m_library, name);
}

bool FmuInstance::instantiate(const QString &resources, bool logs)
{
    const Call inside(m_names->instantiate);
    m_instance = make(m_modelName, QFile::encodeName(resources), logs);
    if (!m_instance && m_usesEventMode) {
        m_usesEventMode = false;
        m_instance = make(m_modelName, QFile::encodeName(resources), logs);
    }
    return m_instance != nullptr;
}

void FmuInstance::free()
{
    if (!m_instance)
        return;
    const Call inside(m_names->freeInstance);
    m_free(m_instance);
    m_instance = nullptr;
}

void FmuInstance::abandon(std::unique_ptr<FmuInstance> instance) noexcept
{
    FmuInstance *own = instance.release();
    own->m_next = s_abandoned.exchange(own);
}

int FmuInstance::setText(fmi::ValueReference reference, const QString &text)
{
    const QByteArray bytes = text.toUtf8();
    const char *value = bytes.constData();
    return set(FmuVariable::String, &reference, 1, &value, 1);
}

int FmuInstance::updateDiscreteStates(bool *needsUpdate, bool *isOver)
{
    *needsUpdate = false;
    *isOver = false;
    return fmi::Ok;
}

}  // namespace qplc

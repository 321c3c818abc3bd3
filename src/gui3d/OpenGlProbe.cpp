// SPDX-License-Identifier: Apache-2.0
#include "OpenGlProbe.h"

#include "QPlcView3D.h"

#include <QtGui/QOffscreenSurface>
#include <QtGui/QOpenGLContext>
#include <QtGui/QOpenGLFunctions>

namespace qplc {

const OpenGlProbe &OpenGlProbe::instance()
{
    static const OpenGlProbe result = probe();
    return result;
}

OpenGlProbe OpenGlProbe::probe()
{
    if (qgetenv("QTPLC_OPENGL") == "off")
        return {QPlcView3D::tr("OpenGL is switched off by QTPLC_OPENGL."), {}};
    QOpenGLContext context;
    if (!context.create())
        return {QPlcView3D::tr("There is no OpenGL on this screen."), {}};
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!surface.isValid() || !context.makeCurrent(&surface))
        return {QPlcView3D::tr("OpenGL does not start on this screen."), {}};
    const auto *name = reinterpret_cast<const char *>(context.functions()->glGetString(GL_RENDERER));
    const QString renderer = QString::fromLatin1(name);
    const bool hasFramebuffers = context.functions()->hasOpenGLFeature(QOpenGLFunctions::Framebuffers);
    const bool hasShaders = context.format().majorVersion() >= 2;  // without them, Qt 3D ends the program
    context.doneCurrent();
    if (!hasFramebuffers || !hasShaders)
        return {QPlcView3D::tr("The OpenGL of %1 is too old.").arg(renderer), renderer};
    return {{}, renderer};
}

}  // namespace qplc

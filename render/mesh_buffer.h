#pragma once

#include "render/gl.h"
#include "render/surface.h"

namespace weft {

/// A surface on the OpenGL side. Attributes: 0 position, 1 normal, 2 ambient, 3 value.
class MeshBuffer {
public:
    explicit MeshBuffer(const Gl& gl);
    void release(const Gl& gl);

    /// Replaces the contents. `expanded`: each triangle gets its own three vertices in order, so
    /// that a shader can tell corners apart.
    void upload(const Gl& gl, const Surface& surface, bool expanded);
    void draw(const Gl& gl) const;

private:
    GLuint array_ = 0, vertices_ = 0, indices_ = 0;
    GLsizei count_ = 0;
    bool expanded_ = false;
};

} // namespace weft

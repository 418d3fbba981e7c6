#include "render/mesh_buffer.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace weft {

namespace {

struct Vertex {
    std::array<float, 3> position;
    std::array<float, 3> normal;
    Ambient ambient;
    float value;
};

Vertex vertex_at(const Surface& s, std::size_t v) {
    const Vec3f& x = s.positions[v];
    const Vec3f& n = s.normals[v];
    return {{x.x(), x.y(), x.z()}, {n.x(), n.y(), n.z()}, s.ambient[v], s.values[v]};
}

void describe(const Gl& gl, GLuint location, GLint components, std::size_t offset) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                           reinterpret_cast<const void*>(offset)); // OpenGL's way to pass an offset
}

} // namespace

MeshBuffer::MeshBuffer(const Gl& gl) {
    gl.GenVertexArrays(1, &array_);
    gl.GenBuffers(1, &vertices_);
    gl.GenBuffers(1, &indices_);
    gl.BindVertexArray(array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    describe(gl, 0, 3, offsetof(Vertex, position));
    describe(gl, 1, 3, offsetof(Vertex, normal));
    describe(gl, 2, 4, offsetof(Vertex, ambient));
    describe(gl, 3, 1, offsetof(Vertex, value));
}

void MeshBuffer::release(const Gl& gl) {
    gl.DeleteVertexArrays(1, &array_);
    gl.DeleteBuffers(1, &vertices_);
    gl.DeleteBuffers(1, &indices_);
}

void MeshBuffer::upload(const Gl& gl, const Surface& surface, bool expanded) {
    expanded_ = expanded;
    count_ = static_cast<GLsizei>(3 * surface.triangles.size());
    std::vector<Vertex> vertices;
    if (expanded) {
        vertices.reserve(3 * surface.triangles.size());
        for (const Triangle& t : surface.triangles) {
            for (const Index v : t) {
                vertices.push_back(vertex_at(surface, static_cast<std::size_t>(v)));
            }
        }
    } else {
        vertices.reserve(surface.positions.size());
        for (std::size_t v = 0; v < surface.positions.size(); ++v) {
            vertices.push_back(vertex_at(surface, v));
        }
    }
    gl.BindVertexArray(array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                  vertices.data(), GL_STREAM_DRAW);
    if (!expanded) {
        gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                      static_cast<GLsizeiptr>(surface.triangles.size() * sizeof(Triangle)),
                      surface.triangles.data(), GL_STREAM_DRAW);
    }
}

void MeshBuffer::draw(const Gl& gl) const {
    if (count_ == 0) {
        return;
    }
    gl.BindVertexArray(array_);
    if (expanded_) {
        gl.DrawArrays(GL_TRIANGLES, 0, count_);
    } else {
        gl.DrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
    }
}

} // namespace weft

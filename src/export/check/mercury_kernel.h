// Members of MercuryDPM that an interaction uses, as the code documents them; every header of the shim is this one.
#ifndef MERCURY_KERNEL_SHIM
#define MERCURY_KERNEL_SHIM
#include <iostream>
#include <string>

typedef double Mdouble;

struct Vec3D {
    double X, Y, Z;
    Vec3D(double x = 0.0, double y = 0.0, double z = 0.0) : X(x), Y(y), Z(z) {}
    Vec3D operator-(const Vec3D &b) const { return Vec3D(X - b.X, Y - b.Y, Z - b.Z); }
    Vec3D operator*(double s) const { return Vec3D(X * s, Y * s, Z * s); }
    static double dot(const Vec3D &a, const Vec3D &b) { return a.X * b.X + a.Y * b.Y + a.Z * b.Z; }
};

class BaseInteractable {
public:
    virtual ~BaseInteractable() {}
    Vec3D getVelocityAtContact(const Vec3D &) const { return Vec3D(); }
};

class BaseParticle : public BaseInteractable {
public:
    double radius = 0.0;
    Mdouble getRadius() const { return radius; }
};

class BaseWall : public BaseInteractable {};

class BaseInteraction {
public:
    BaseInteraction(BaseInteractable *p, BaseInteractable *i, unsigned) : p_(p), i_(i) {}
    BaseInteraction() : p_(nullptr), i_(nullptr) {}
    virtual ~BaseInteraction() {}
    virtual void write(std::ostream &os) const { os << "interaction"; }
    virtual void read(std::istream &is)
    {
        std::string dummy;
        is >> dummy;
    }
    virtual Mdouble getElasticEnergy() const { return 0.0; }
    virtual BaseInteraction *copy() const = 0;
    BaseInteractable *getP() { return p_; }
    BaseInteractable *getI() { return i_; }
    const BaseInteractable *getP() const { return p_; }
    const BaseInteractable *getI() const { return i_; }
    Mdouble getOverlap() const { return overlap; }
    const Vec3D &getNormal() const { return normal; }
    const Vec3D &getContactPoint() const { return point; }
    const Vec3D &getRelativeVelocity() const { return velocity; }
    void setForce(Vec3D f) { force = f; }
    double overlap = 0.0;
    Vec3D normal, force;

protected:
    void setRelativeVelocity(Vec3D v) { velocity = v; }
    void setNormalRelativeVelocity(Mdouble) {}
    void setAbsoluteNormalForce(Mdouble) {}
    void setTorque(Vec3D) {}

private:
    BaseInteractable *p_, *i_;
    Vec3D point, velocity;
};

class BaseNormalForce {};
#endif

"""The sphere and the teapot by Mitsuba 3 (Jakob et al. 2022): its geometry, environment map, microfacet code, estimator.

What differs from the contract, and what is done about it:
- Mitsuba's envmap has its texels at other places: column i at u = (i + ½)/W, but row j at v = j/(H − 1). The panorama
  is handed over on a grid of 3 W × (2 H + 1) texels, whose lines include every line at which the bilinear panorama has
  a kink; on such a grid bilinear interpolation is the same function. check_panorama() makes sure of it.
- roughconductor takes Smith's masking of the two directions as independent, G1(i) G1(o). The project's GGX has them
  height-correlated, 1/(1 + Λ(i) + Λ(o)) (Heitz 2014, eq. 99). The reflectance is multiplied by the quotient of the
  two, (1 + Λ(i))(1 + Λ(o))/(1 + Λ(i) + Λ(o)).
- Ward is Beckmann's distribution with another factor: D_Beckmann h_z⁴ / (4 √(i_z o_z)) instead of D G/(4 i_z o_z). The
  quotient is h_z⁴ √(i_z o_z)/G, with Mitsuba's own G.
- A sphere's tangent goes around its z axis; it is turned so that this is the world's y axis.
- Rays start at the pixels' centres.
- A mesh without texture coordinates has arbitrary tangents: the reflectance is evaluated in a frame about Mitsuba's own
  interpolated normal whose tangent is (0, 1, 0) × normal.
- The reference knows no shadows and no light that is reflected twice. The sphere has neither. On the teapot Mitsuba's
  `direct` integrator would cast shadows: render_mesh() takes its two samplers, of the reflectance and of the light, and
  the balance heuristic (Veach 1997) without them.
"""

import drjit as dr
import mitsuba as mi
import numpy as np

import contract

mi.set_variant("llvm_ad_rgb")


class Reweighted(mi.BSDF):
    """roughconductor without Fresnel, times a quotient of reflectances.

    With `turned`, the tangent is not the shape's but (0, 1, 0) × normal.
    """

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.brdf = props["brdf"]
        self.alpha = (props["alpha_x"], props["alpha_y"])
        self.turned = props.get("turned", False)
        distribution = "beckmann" if self.brdf == "ward" else "ggx"
        self.stock = mi.load_dict(
            {
                "type": "roughconductor",
                "material": "none",
                "distribution": distribution,
                "alpha_u": self.alpha[0],
                "alpha_v": self.alpha[1],
            }
        )
        self.facets = mi.MicrofacetDistribution(
            mi.MicrofacetType.Beckmann if self.brdf == "ward" else mi.MicrofacetType.GGX, *self.alpha
        )
        flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide | mi.BSDFFlags.Anisotropic
        self.m_components = [flags]
        self.m_flags = flags

    def smith_lambda(self, v):
        slope = (dr.square(self.alpha[0] * v.x) + dr.square(self.alpha[1] * v.y)) / dr.square(v.z)
        return 0.5 * (dr.sqrt(1 + slope) - 1)

    def quotient(self, o, i):
        if self.brdf == "ggx":
            light, view = self.smith_lambda(i), self.smith_lambda(o)
            value = (1 + light) * (1 + view) / (1 + light + view)
        else:
            h = dr.normalize(i + o)
            masking = self.facets.G(o, i, h)
            value = dr.square(dr.square(h.z)) * dr.sqrt(i.z * o.z) / dr.maximum(masking, 1e-20)
        return dr.select((i.z > 0) & (o.z > 0), value, 0)

    def own(self, si, *directions):
        """The interaction and directions of its frame, in the frame of `turned`; and that frame."""
        frame = si.sh_frame
        if not self.turned:
            return (si, *directions, frame)
        tangent = dr.normalize(dr.cross(mi.Vector3f(0, 1, 0), frame.n))
        own = mi.Frame3f(tangent, dr.cross(frame.n, tangent), frame.n)
        turned = mi.SurfaceInteraction3f(si)
        turned.wi = own.to_local(frame.to_world(si.wi))
        return (turned, *(own.to_local(frame.to_world(direction)) for direction in directions), own)

    def sample(self, ctx, si, sample1, sample2, active):
        turned, own = self.own(si)
        drawn, weight = self.stock.sample(ctx, turned, sample1, sample2, active)
        weight = weight * self.quotient(turned.wi, drawn.wo)
        drawn.wo = si.sh_frame.to_local(own.to_world(drawn.wo))
        return drawn, weight

    def eval(self, ctx, si, wo, active):
        turned, out, _ = self.own(si, wo)
        return self.stock.eval(ctx, turned, out, active) * self.quotient(turned.wi, out)

    def pdf(self, ctx, si, wo, active):
        turned, out, _ = self.own(si, wo)
        return self.stock.pdf(ctx, turned, out, active)

    def eval_pdf(self, ctx, si, wo, active):
        turned, out, _ = self.own(si, wo)
        value, pdf = self.stock.eval_pdf(ctx, turned, out, active)
        return value * self.quotient(turned.wi, out), pdf

    def to_string(self):
        return f"Reweighted[{self.brdf}, {self.alpha}]"


mi.register_bsdf("lobelight_reweighted", Reweighted)


def environment(panorama):
    """The envmap emitter for a panorama (height, width, 3)."""
    height, width = panorama.shape[:2]
    x = (np.arange(3 * width) + 0.5) / 3
    y = np.arange(2 * height + 1) / 2
    grid = contract.bilinear(panorama, *np.meshgrid(x, y))
    return {"type": "envmap", "bitmap": mi.Bitmap(grid.astype(np.float32))}


def check_panorama(panorama, directions=20000):
    """Largest difference between Mitsuba's envmap and the panorama over random directions, over the latter's mean."""
    random = np.random.default_rng(1)
    d = random.normal(size=(directions, 3))
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    emitter = mi.load_dict(environment(panorama))
    interaction = dr.zeros(mi.SurfaceInteraction3f, directions)
    interaction.wi = -mi.Vector3f(d.T.astype(np.float32))
    theirs = np.array(emitter.eval(interaction)).T
    # In the same precision: at the edge of a sun a float's last bit of direction shows.
    d = d.astype(np.float32).astype(np.float64)
    u = np.arctan2(d[:, 0], -d[:, 2]) / (2 * np.pi) % 1.0
    v = np.arccos(np.clip(d[:, 1], -1, 1)) / np.pi
    ours = contract.bilinear(panorama, u * panorama.shape[1], v * panorama.shape[0])
    return float(np.max(np.abs(theirs - ours) / (ours + ours.mean())))


def material(brdf, alpha, turned=False):
    """The description of a Reweighted."""
    widths = {"alpha_x": float(alpha[0]), "alpha_y": float(alpha[1])}
    return {"type": "lobelight_reweighted", "brdf": brdf, "turned": turned, **widths}


def mean_of_batches(batches, batch):
    """Mean and standard error of batch(number), arrays of one shape."""
    means = np.array([batch(number) for number in range(batches)])
    return means.mean(axis=0), means.std(axis=0, ddof=1) / np.sqrt(batches)


def averaged(value, count, per_batch):
    """The mean over the samples of each pixel, (count, 3)."""
    return np.array(value).T.reshape(count, per_batch, 3).mean(axis=1, dtype=np.float64)


def render(panorama, brdf, alpha, size, samples, batches=16):
    """Radiance (size, size, 3) and its standard error from the spread of independent batches; 0 beside the sphere.

    `samples`: light samples a pixel in all, and as many of the reflectance.
    """
    scene = mi.load_dict(
        {
            "type": "scene",
            "light": environment(panorama),
            "sphere": {
                "type": "sphere",
                "to_world": mi.ScalarTransform4f().rotate([1, 0, 0], -90),
                "bsdf": material(brdf, alpha),
            },
        }
    )
    integrator = mi.load_dict({"type": "direct", "bsdf_samples": 1, "emitter_samples": 1})
    centre = (2 * np.arange(size) + 1) / size - 1
    x, y = np.meshgrid(centre, -centre)
    inside = x**2 + y**2 < 1
    per_batch = max(1, samples // batches)
    count = int(np.count_nonzero(inside))
    origin = np.stack([x[inside], y[inside], np.full(count, 3.0)]).astype(np.float32)
    ray = mi.Ray3f(
        mi.Point3f(np.repeat(origin, per_batch, axis=1)), mi.Vector3f(0.0, 0.0, -1.0)
    )

    def batch(number):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(number, count * per_batch)
        value, _, _ = integrator.sample(scene, sampler, mi.RayDifferential3f(ray))
        return averaged(value, count, per_batch)

    radiance, error = np.zeros((size, size, 3)), np.zeros((size, size, 3))
    radiance[inside], error[inside] = mean_of_batches(batches, batch)
    return radiance, error


def without_shadows(scene, bsdf, si, sampler):
    """One estimate of the light that surfaces reflect, as if each were alone: a sample of the light and one of the BSDF."""
    context, light = mi.BSDFContext(), scene.environment()
    found, weight = light.sample_direction(si, sampler.next_2d())
    value, pdf = bsdf.eval_pdf(context, si, si.to_local(found.d), True)
    lit = (found.pdf > 0) & (found.pdf + pdf > 0)
    result = dr.select(lit, value * weight * (found.pdf / (found.pdf + pdf)), 0)

    drawn, weight = bsdf.sample(context, si, sampler.next_1d(), sampler.next_2d(), True)
    direction = dr.zeros(mi.DirectionSample3f)
    direction.d = si.to_world(drawn.wo)
    seen = dr.zeros(mi.SurfaceInteraction3f)
    seen.wi = -direction.d
    light_pdf = light.pdf_direction(si, direction)
    drawn_any = drawn.pdf > 0
    return result + dr.select(drawn_any, weight * light.eval(seen) * (drawn.pdf / (drawn.pdf + light_pdf)), 0)


def render_mesh(panorama, path, camera, brdf, alpha, samples, batches=16):
    """Radiance, its standard error and Mitsuba's normals of a mesh, (height, width, 3) each; 0 beside it.

    `samples`: of the light a pixel in all, and as many of the reflectance. No shadows, no light reflected twice.
    """
    scene = mi.load_dict({"type": "scene", "light": environment(panorama), "mesh": {"type": "obj", "filename": str(path)}})
    bsdf = mi.load_dict(material(brdf, alpha, turned=True))
    view = camera.axes()[2]
    places = camera.places().reshape(-1, 3) + 8.0 * view

    def interactions(origins):
        ray = mi.Ray3f(mi.Point3f(origins.T.astype(np.float32)), mi.Vector3f((-view).tolist()))
        return scene.ray_intersect(ray)

    once = interactions(places)
    hit = np.array(once.is_valid())
    normal = np.where(hit[:, None], np.array(once.sh_frame.n).T, 0.0)
    count, per_batch = int(np.count_nonzero(hit)), max(1, samples // batches)
    si = interactions(np.repeat(places[hit], per_batch, axis=0))
    dr.eval(si)

    def batch(number):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(number, count * per_batch)
        return averaged(without_shadows(scene, bsdf, si, sampler), count, per_batch)

    radiance, error = np.zeros((len(hit), 3)), np.zeros((len(hit), 3))
    radiance[hit], error[hit] = mean_of_batches(batches, batch)
    return tuple(picture.reshape(camera.height, camera.width, 3) for picture in (radiance, error, normal))
